/** Change against a baseline, and what it means. */

import { isNothing } from "../units/format";

export type Verdict = "better" | "worse" | "same" | "none";

export interface Change {
  /** In percent, negative is lower; `null` where there is nothing to compare with. */
  readonly percent: number | null;
  readonly verdict: Verdict;
}

/** Smaller changes than this [%] would print as zero. */
const NOTHING = 0.05;

/** Every compared figure is one where lower is better. A change against a zero baseline does not exist. */
export function changeAgainst(value: number | null | undefined, baseline: number | null | undefined): Change {
  if (typeof value !== "number" || typeof baseline !== "number" || isNothing(baseline)) return { percent: null, verdict: "none" };
  const percent = ((value - baseline) / Math.abs(baseline)) * 100;
  if (Math.abs(percent) < NOTHING) return { percent: 0, verdict: "same" };
  return { percent, verdict: percent < 0 ? "better" : "worse" };
}

/** `−43.7 %`: a sign always, one decimal up to 100 %, none beyond. */
export function formatPercent(percent: number): string {
  const size = Math.abs(percent);
  const digits = size < 99.95 ? size.toFixed(1) : size < 9999.5 ? size.toFixed(0) : ">9999";
  return `${percent < 0 ? "−" : percent > 0 ? "+" : "±"}${digits}\u2009%`;
}
