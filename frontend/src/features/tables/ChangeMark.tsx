/** A change in percent: sign and arrow say better or worse, colour only repeats it. */

import { changeAgainst, formatPercent, type Change } from "./change";
import classes from "./tables.module.css";

const ARROW = { better: "▼", worse: "▲", same: "", luck: "", none: "" } as const;

const WORDS = { better: "better", worse: "worse", luck: "within one road’s luck" } as const;

interface Props {
  readonly value: number | null | undefined;
  readonly baseline: number | null | undefined;
}

export function ChangeMark({ value, baseline }: Props) {
  return <ChangeText change={changeAgainst(value, baseline)} />;
}

/** The change; an empty line for what changes are against. */
export function ChangeText({ change }: { readonly change: Change | null }) {
  if (change === null) return <span className={classes.change}>&nbsp;</span>;
  const { percent, half, verdict } = change;
  if (percent === null) return <span className={classes.change}>–</span>;
  return (
    <span className={classes.change} data-verdict={verdict} title={verdict === "luck" ? WORDS.luck : undefined}>
      <span aria-hidden>{ARROW[verdict]}</span> {formatPercent(percent, half)}
      {verdict in WORDS && <span className="visually-hidden">, {WORDS[verdict as keyof typeof WORDS]}</span>}
    </span>
  );
}
