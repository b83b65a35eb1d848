/** The tab's title; on paper also where this comes from. */

import { useDocumentTitle } from "@mantine/hooks";
import { useFromScenario, useLab } from "../../lab/context";
import { pageTitle } from "./title";
import classes from "../../ui/shell.module.css";

export function PrintedTitle() {
  const source = useLab(
    ({ shown }) =>
      shown && `core ${shown.coreVersion}${shown.runId === null ? ", a live preview" : `, run ${shown.runId}`}`,
  );
  const title = useFromScenario(pageTitle);
  useDocumentTitle(title);
  if (source === null) return null;
  return (
    <p className={classes.printed}>
      {title} {source}
    </p>
  );
}
