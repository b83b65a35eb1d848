/** A result in its unit: plain, or the mean over several roads with half its 95 % interval's width. */

import type { Interval } from "../../api/types";
import { formatHalf, formatResult, isNothing, NO_VALUE } from "../../units/format";
import classes from "./tables.module.css";

interface Props {
  readonly value: number | null | undefined;
  readonly interval: Interval | undefined;
  /** From SI to the unit shown. */
  readonly scale: number;
}

export function Estimated({ value, interval, scale }: Props) {
  const half = interval ? (interval.high - interval.mean) * scale : 0;
  const shown = typeof value === "number" ? formatResult(value * scale) : NO_VALUE;
  return (
    <span className={classes.value}>
      {shown}
      {!isNothing(half) && <span className={classes.half}>{`\u2009±\u2009${formatHalf(half, shown)}`}</span>}
    </span>
  );
}
