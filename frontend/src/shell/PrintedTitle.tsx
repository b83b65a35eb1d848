/** On paper only: what this is about and where it comes from. */

import { useLab, useScenario } from "../state/context";
import { pageTitle } from "../title";
import classes from "./shell.module.css";

export function PrintedTitle() {
  const shown = useLab((state) => state.shown);
  const scenario = useScenario();
  if (!shown) return null;
  const source = `core ${shown.coreVersion}${shown.runId === null ? ", a live preview" : `, run ${shown.runId}`}`;
  return (
    <p className={classes.printed}>
      {pageTitle(scenario)} {source}
    </p>
  );
}
