/** A change in percent: sign and arrow say better or worse, colour only repeats it. */

import { formatPercent, type Change, type Caveat } from "./change";
import classes from "./tables.module.css";
import type { Interval } from "../../api/types";
import { formatHalf, formatResult, isNothing, NO_VALUE } from "../../units/format";
import { Icon } from "../../ui/icons";
import ui from "../../ui/ui.module.css";
import { UnstyledButton } from "@mantine/core";

const ARROW = { better: "▼", worse: "▲", same: "", random: "", unclear: "≈", none: "" } as const;

const WORDS = {
  better: "better",
  worse: "worse",
  random: "not beyond the random variation of one road",
  unclear: "no certain difference",
} as const;

interface ValueProps {
  readonly text: string;
  /** `null` for what changes are against. */
  readonly change: Change | null;
}

/** A number, and under it its change. */
export const ValueAndChange = ({ text, change }: ValueProps) => (
  <>
    <span className={classes.value}>{text}</span>
    <ChangeText change={change} />
  </>
);

/** The change; an empty line for what changes are against. */
export function ChangeText({ change }: { readonly change: Change | null }) {
  if (change === null) return <span className={classes.change}>&nbsp;</span>;
  const { percent, half, verdict } = change;
  if (percent === null) return <span className={classes.change}>–</span>;
  return (
    <span className={classes.change} data-verdict={verdict} title={verdict === "random" ? WORDS.random : undefined}>
      <span aria-hidden>{ARROW[verdict]}</span> {formatPercent(percent, half)}
      {verdict in WORDS && <span className="visually-hidden">, {WORDS[verdict as keyof typeof WORDS]}</span>}
    </span>
  );
}

interface SureProps {
  readonly value: number;
  /** Its interval's ends, where it has one. */
  readonly low: number | null;
  readonly high: number | null;
  /** The interval in words, where it does not stand elsewhere. */
  readonly children?: string;
}

/** A change [%] that is better or worse only where its whole interval is. */
export function SureChange({ value, low, high, children }: SureProps) {
  const verdict = high !== null && high < 0 ? "better" : low !== null && low > 0 ? "worse" : "unclear";
  return (
    <>
      <ChangeText change={{ percent: value, half: 0, verdict }} />
      {children !== undefined && <span className={ui.under}>{children}</span>}
    </>
  );
}

interface EstimatedProps {
  readonly value: number | null | undefined;
  readonly interval: Interval | undefined;
  /** From SI to the unit shown. */
  readonly scale: number;
  /** The best of its kind. */
  readonly isBest?: boolean;
}

/** A result in its unit: plain, or the mean over several roads with half its 95 % interval's width. */
export function Estimated({ value, interval, scale, isBest = false }: EstimatedProps) {
  const half = interval ? (interval.high - interval.mean) * scale : 0;
  const shown = typeof value === "number" ? formatResult(value * scale) : NO_VALUE;
  return (
    <span className={classes.value} data-best={isBest || undefined}>
      {shown}
      {!isNothing(half) && <span className={ui.dim}>{`\u2009±\u2009${formatHalf(half, shown)}`}</span>}
    </span>
  );
}

const CAVEAT = {
  display: "inline-flex",
  mih: 24,
  maw: "100%",
  c: "var(--worse)",
  fz: "inherit",
  fw: 500,
  style: { gap: 3, alignItems: "center", textAlign: "inherit", cursor: "help" },
} as const;

interface CaveatMarkProps {
  readonly caveats: readonly Caveat[];
  readonly short?: boolean;
}

/** The caveats of a result; on hover, focus or touch what they mean. */
export function CaveatMark({ caveats, short = false }: CaveatMarkProps) {
  if (caveats.length === 0) return null;
  const text = caveats.map((caveat) => caveat.text).join(", ");
  const meaning = caveats.map((caveat) => `${caveat.text}: ${caveat.description}`).join("\n");
  return (
    <UnstyledButton
      data-hint={meaning}
      data-hint-only
      {...CAVEAT}
      data-caveat={caveats.map(({ event }) => event).join(" ")}
    >
      <Icon name="AlertTriangle" size={short ? 14 : 12} />
      <span className={short ? "visually-hidden" : ""}>{text}</span>
    </UnstyledButton>
  );
}
