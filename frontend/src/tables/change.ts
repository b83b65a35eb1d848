/** Change against a baseline, and what it means. */

import type { Interval } from "../api/types";
import { formatResult, isNothing } from "../units/format";

export type Verdict = "better" | "worse" | "same" | "none";

export interface Change {
  /** In percent, negative is lower; `null` where there is nothing to compare with. */
  readonly percent: number | null;
  /** Half the width of its interval; 0 where it has none. */
  readonly half: number;
  readonly verdict: Verdict;
}

/** Smaller changes than this [%] would print as zero. */
const NOTHING = 0.05;

/**
 * Every compared figure is one where lower is better. A change against a zero baseline does not exist, and between two
 * that are shown by the same digits none is better.
 *
 * @param scale From the values to the unit shown.
 */
export function changeAgainst(value: number | null | undefined, baseline: number | null | undefined, scale = 1): Change {
  if (typeof value !== "number" || typeof baseline !== "number" || isNothing(baseline)) return { percent: null, half: 0, verdict: "none" };
  const percent = ((value - baseline) / Math.abs(baseline)) * 100;
  if (Math.abs(percent) < NOTHING) return { percent: 0, half: 0, verdict: "same" };
  if (formatResult(value * scale) === formatResult(baseline * scale)) return { percent, half: 0, verdict: "same" };
  return { percent, half: 0, verdict: percent < 0 ? "better" : "worse" };
}

/** A change over several roads; one whose interval holds zero is none that these roads resolve. */
export function pairedChange({ mean, low, high }: Interval): Change {
  const open = Math.abs(mean) < NOTHING || (low <= 0 && high >= 0);
  return { percent: mean, half: high - mean, verdict: open ? "same" : mean < 0 ? "better" : "worse" };
}

/** A change between two runs over roads that are not paired: the intervals of both make its own. */
export function separateChange(value: Interval, reference: Interval): Change {
  if (isNothing(reference.mean)) return { percent: null, half: 0, verdict: "none" };
  const part = 100 / Math.abs(reference.mean);
  const mean = (value.mean - reference.mean) * part;
  const half = Math.hypot(value.high - value.mean, reference.high - reference.mean) * part;
  return pairedChange({ mean, low: mean - half, high: mean + half });
}

/** `−43.7 %`: a sign always, one decimal up to 100 %, none beyond; with half an interval's width `−44 ± 2 %`. */
export function formatPercent(percent: number, half = 0): string {
  const sign = percent < 0 ? "−" : percent > 0 ? "+" : "±";
  const size = Math.abs(percent);
  const decimals = size < 99.95 && half < 0.95 ? 1 : 0;
  const digits = size < 9999.5 ? size.toFixed(decimals) : ">9999";
  return `${sign}${digits}${half > 0 ? `\u2009±\u2009${half.toFixed(decimals)}` : ""}\u2009%`;
}
