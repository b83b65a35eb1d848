/** A change in percent: sign and arrow say better or worse, colour only repeats it. */

import type { Interval } from "../api/types";
import { changeAgainst, formatPercent, pairedChange } from "./change";
import classes from "./tables.module.css";

const ARROW = { better: "▼", worse: "▲", same: "", none: "" } as const;

interface Props {
  readonly value: number | null | undefined;
  readonly baseline: number | null | undefined;
  /** Over several roads the paired change. */
  readonly paired?: Interval | null | undefined;
  /** From the values to the unit shown. */
  readonly scale?: number;
}

export function ChangeMark({ value, baseline, paired, scale }: Props) {
  const { percent, half, verdict } = paired ? pairedChange(paired) : changeAgainst(value, baseline, scale);
  if (percent === null) return <span className={classes.change}>–</span>;
  return (
    <span className={classes.change} data-verdict={verdict}>
      <span aria-hidden>{ARROW[verdict]}</span> {formatPercent(percent, half)}
      {verdict !== "same" && <span className="visually-hidden">, {verdict}</span>}
    </span>
  );
}
