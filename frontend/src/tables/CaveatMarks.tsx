/** A line for each caveat of a result, with what it means on hover, focus or touch. */

import { Tooltip } from "@mantine/core";
import { IconAlertTriangle } from "../icons";
import type { Caveat } from "./caveats";
import classes from "./tables.module.css";

interface Props {
  readonly caveats: readonly Caveat[];
  /** For a column's head: at its right. */
  readonly upright?: boolean;
}

export function CaveatMarks({ caveats, upright = false }: Props) {
  if (caveats.length === 0) return null;
  return (
    <span className={classes.caveats} data-upright={upright || undefined}>
      {caveats.map(({ event, text, description }) => (
        <Tooltip key={event} label={description} multiline w={260} withinPortal events={{ hover: true, focus: true, touch: true }}>
          <button type="button" className={classes.caveat} data-caveat={event}>
            <IconAlertTriangle size={12} stroke={2} aria-hidden />
            <span>{text}</span>
          </button>
        </Tooltip>
      ))}
    </span>
  );
}
