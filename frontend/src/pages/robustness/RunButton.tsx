/** A value whose run opens in the lab; the fields there are in the tooltip. */

import { Button } from "@mantine/core";
import { Icon } from "../../ui/icons";
import { nameOf, useFieldText } from "./names";
import type { ExtremeRun } from "./summary";
import type { Opening } from "../../features/sweep/useOpenRun";

interface Props {
  readonly run: ExtremeRun | null;
  readonly text: string;
  /** Which value it is, in words. */
  readonly what: string;
  readonly opening: Opening;
}

export function RunButton({ run, text, what, opening }: Props) {
  const fieldText = useFieldText();
  if (run === null) return <>–</>;
  const fields = Object.entries(run.at).map(([name, value]) => `${nameOf(name)} ${fieldText(name, value)}`);
  return (
    <Button
      data-hint={`Open run ${run.run} in the lab: ${fields.join(", ")}`}
      size="compact-xs"
      variant="subtle"
      px="0.3rem"
      fw={500}
      loading={opening.opening?.run === run.run}
      rightSection={<Icon name="ExternalLink" size={13} />}
      aria-label={`${what} ${text}: open run ${run.run} in the lab`}
      onClick={() => opening.open(run)}
    >
      {text}
    </Button>
  );
}
