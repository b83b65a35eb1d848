/** A result in its unit: plain, or the mean over several roads with half its 95 % interval's width. */

import type { Interval } from "../api/types";
import { formatResult, isNothing } from "../units/format";
import classes from "./tables.module.css";

interface Props {
  readonly value: number | null | undefined;
  readonly interval: Interval | undefined;
  /** From SI to the unit shown. */
  readonly scale: number;
}

export function Estimated({ value, interval, scale }: Props) {
  const half = interval ? (interval.high - interval.mean) * scale : 0;
  return (
    <span className={classes.value}>
      {typeof value === "number" ? formatResult(value * scale) : "–"}
      {!isNothing(half) && <span className={classes.half}> ± {formatResult(half, 2)}</span>}
    </span>
  );
}
