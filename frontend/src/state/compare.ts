/** What the shown result is compared with: the state before the last edit, and pinned variants. */

import type { Shown } from "./shown";

/** A result with a name, of the strategies that are on. */
export interface Variant {
  readonly name: string;
  readonly shown: Shown;
  /** Its place among the pins, which gives it its line. */
  readonly place?: number;
}

/** What changes in percent are against: another strategy, the state before the last edit, or a pinned run. */
export type Against = "baseline" | "before" | `pin:${string}`;

export interface Compared {
  readonly before: Shown | null;
  readonly pins: readonly Variant[];
  readonly against: Against;
  /** Plots show differences to it. */
  readonly residual: boolean;
}

export const NOTHING_COMPARED: Compared = { before: null, pins: [], against: "baseline", residual: false };

export const againstPin = (runId: string): Against => `pin:${runId}`;

/** The variant that changes are against; `null` where that is a strategy. */
export function referenceOf({ before, pins, against }: Compared): Variant | null {
  if (against === "before") return before && { name: "before the last edit", shown: before };
  return pins.find(({ shown }) => against === againstPin(shown.runId ?? "")) ?? null;
}
