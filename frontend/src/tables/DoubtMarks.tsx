/** A line for each reason to doubt a result, with what it means on hover, focus or touch. */

import { Tooltip } from "@mantine/core";
import { IconAlertTriangle } from "../icons";
import type { Doubt } from "./doubts";
import classes from "./tables.module.css";

interface Props {
  readonly doubts: readonly Doubt[];
  /** For a column's head: at its right. */
  readonly upright?: boolean;
}

export function DoubtMarks({ doubts, upright = false }: Props) {
  if (doubts.length === 0) return null;
  return (
    <span className={classes.doubts} data-upright={upright || undefined}>
      {doubts.map(({ event, text, description }) => (
        <Tooltip key={event} label={description} multiline w={260} withinPortal events={{ hover: true, focus: true, touch: true }}>
          <button type="button" className={classes.doubt} data-doubt={event}>
            <IconAlertTriangle size={12} stroke={2} aria-hidden />
            <span>{text}</span>
          </button>
        </Tooltip>
      ))}
    </span>
  );
}
