/** Change against a baseline and what it means, and what makes a result one that no real car would have had. */

import type { Interval, Catalogue, Quantity, Summary } from "../../api/types";
import { formatResult, formatInput, prettyUnit } from "../../units/format";

/** `random`: not beyond the random variation of one road. `unclear`: its interval, which is shown, contains zero. */
export type Verdict = "better" | "worse" | "same" | "random" | "unclear" | "none";

export interface Change {
  /** In percent, negative is lower; `null` where there is nothing to compare with. */
  readonly percent: number | null;
  /** Half the width of its interval; 0 where it has none. */
  readonly half: number;
  readonly verdict: Verdict;
}

/** Smaller changes than this [%] would print as zero. */
const NOTHING = 0.05;

/** What a control loop's rounding leaves on a flat road is below this, in any unit that is shown. */
const RESOLVED = 1e-6;

interface OnOneRoad {
  /** From the values to the unit shown. */
  readonly scale?: number;
  /** Smaller changes [%] may be random. */
  readonly oneRoadNoise?: number;
}

/**
 * Every compared figure is one where lower is better. A change against a zero baseline does not exist, and between two
 * that are shown by the same digits none is better.
 */
export function changeAgainst(
  value: number | null | undefined,
  baseline: number | null | undefined,
  { scale = 1, oneRoadNoise = 0 }: OnOneRoad = {},
): Change {
  const isZero = (each: number) => Math.abs(each * scale) < RESOLVED;
  if (typeof value !== "number" || typeof baseline !== "number" || isZero(baseline)) {
    const isBothNothing = typeof value === "number" && typeof baseline === "number" && isZero(value);
    return { percent: null, half: 0, verdict: isBothNothing ? "same" : "none" };
  }
  const percent = ((value - baseline) / Math.abs(baseline)) * 100;
  const change = (verdict: Verdict): Change => ({ percent, half: 0, verdict });
  if (Math.abs(percent) < NOTHING) return { ...change("same"), percent: 0 };
  if (areAlike(value, baseline, scale)) return change("same");
  return change(Math.abs(percent) < oneRoadNoise ? "random" : percent < 0 ? "better" : "worse");
}

/** Whether two values show as the same digits in the unit that `scale` leads to. */
export const areAlike = (value: number | null | undefined, other: number | null | undefined, scale: number): boolean =>
  typeof value === "number" && typeof other === "number" && formatResult(value * scale) === formatResult(other * scale);

/** A change over several roads; none where its interval contains zero, or where both means show as the same digits. */
export function pairedChange({ mean, low, high }: Interval, isAlike = false): Change {
  const open = isAlike || Math.abs(mean) < NOTHING || (low <= 0 && high >= 0);
  return { percent: mean, half: high - mean, verdict: open ? "same" : mean < 0 ? "better" : "worse" };
}

/** `−43.7 %`: a sign unless it is 0, one decimal up to 100 %, none beyond; with half an interval's width, where that is not 0, `−44 ± 2 %`. */
export function formatPercent(percent: number, half = 0): string {
  const size = Math.abs(percent);
  const decimals = size < 99.95 && half < 0.95 ? 1 : 0;
  const digits = Math.min(size, 9999).toFixed(decimals);
  const sign = Number(digits) === 0 ? "" : percent < 0 ? "−" : "+";
  const beyond = size < 9999.5 ? "" : percent < 0 ? "< " : "> ";
  const uncertainty = half.toFixed(decimals);
  return `${beyond}${sign}${digits}${Number(uncertainty) === 0 ? "" : `\u2009±\u2009${uncertainty}`}\u2009%`;
}

type Events = Summary["events"];

export interface Caveat {
  readonly event: string;
  /** A few words: `airborne 94 ms`. */
  readonly text: string;
  /** The catalogue's words for it. */
  readonly description: string;
}

type Wording = (value: number | boolean, quantity: Pick<Quantity, "unit" | "notable">) => string | null;

const amount = (value: number, unit: string) =>
  `${formatInput(value < 10 ? Number(value.toPrecision(2)) : Math.round(value))}\u00a0${prettyUnit(unit)}`;

/** In words from the size on that the catalogue says; `null` below it. */
const notable =
  (say: (shown: string) => string): Wording =>
  (value, quantity) =>
    typeof value === "number" && value >= quantity.notable ? say(amount(value, quantity.unit)) : null;

const WORDINGS: Readonly<Record<string, Wording>> = {
  airborne_ms: notable((shown) => `airborne ${shown}`),
  stop_contact_ms: notable((shown) => `on a bump stop ${shown}`),
  travel_exceeded_mm: notable((shown) => `${shown} over the travel limit`),
  target_reached: (value) => (value === false ? "target speed not reached" : null),
};

/** The events that are caveats of a result. */
export const CAVEAT_EVENTS = Object.keys(WORDINGS);

export function caveatsOf(events: Events | undefined, catalogue: Pick<Catalogue, "events">): readonly Caveat[] {
  return Object.entries(WORDINGS).flatMap(([event, wording]) => {
    const value = events?.[event];
    const quantity = catalogue.events.find(({ key }) => key === event);
    const text = value === null || value === undefined || quantity === undefined ? null : wording(value, quantity);
    return text === null ? [] : [{ event, text, description: `${quantity?.label}: ${quantity?.description}` }];
  });
}
