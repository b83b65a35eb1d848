/** What the shown result is compared with: the state before the last edit, and pinned variants. */

import type { Shown } from "./shown";

/** A result with a name, of the strategies that are on. */
export interface Variant {
  readonly name: string;
  readonly shown: Shown;
  /** The run that was pinned: what is shown is its scenario over as many roads as the lab drives. */
  readonly run?: string;
  /** Its place among the pins, which gives it its line. */
  readonly index?: number;
}

/** What changes in percent are against: another strategy, the state before the last edit, or a pinned run. */
export type Against = "baseline" | "before" | `pin:${string}`;

export interface Compared {
  readonly before: Shown | null;
  readonly pins: readonly Variant[];
}

export const NOTHING_COMPARED: Compared = { before: null, pins: [] };

const PIN = "pin:";
export const againstPin = (runId: string): Against => `${PIN}${runId}`;

export const againstVariant = ({ run, shown }: Variant): Against => againstPin(run ?? shown.runId ?? "");

/** The run of the pin that changes are against; `null` where they are against something else. */
export const runOf = (against: Against): string | null => (against.startsWith(PIN) ? against.slice(PIN.length) : null);

/** The variant that changes are against; `null` where that is a strategy. */
export function againstOf({ before, pins }: Compared, against: Against): Variant | null {
  if (against === "before") return before && { name: "before the last edit", shown: before };
  return pins.find((pin) => against === againstVariant(pin)) ?? null;
}
