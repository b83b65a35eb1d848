/** What the shown result is compared with: the state before the last edit, and pinned variants. */

import type { OverRoads } from "../api/types";
import { getAt } from "../scenario/path";
import { count } from "../units/format";
import { roadsOf, type Result } from "./result";

/** A result with a name, of the strategies that are on. */
export interface Variant {
  readonly name: string;
  readonly shown: Result;
  /** The run that was pinned: what is shown is its scenario over as many roads as the lab drives. */
  readonly run?: string;
  /** Its place among the pins, which gives it its line. */
  readonly index?: number;
}

/** What changes in percent are against: another strategy, the state before the last edit, or a pinned run. */
export type Reference = "baseline" | "before" | `pin:${string}`;

export interface Compared {
  readonly before: Variant | null;
  readonly pins: readonly Variant[];
}

/** By run over several roads its changes against what changes are against, where the run itself does not have them. */
export type RoadPairedChanges = Readonly<Record<string, OverRoads["changes"]>>;

export const NOTHING_COMPARED: Compared = { before: null, pins: [] };

const SEED = "/road/seed";
const PIN = "pin:";
export const pinReference = (runId: string): Reference => `${PIN}${runId}`;

export const referenceTo = ({ run, shown }: Variant): Reference => pinReference(run ?? shown.runId ?? "");

/** The run of the pin that changes are against; `null` where they are against something else. */
export const pinnedRunId = (reference: Reference): string | null =>
  reference.startsWith(PIN) ? reference.slice(PIN.length) : null;

/** The variant that changes are against; `null` where that is a strategy. */
export function referenceVariant({ before, pins }: Compared, reference: Reference): Variant | null {
  return reference === "before" ? before : (pins.find((pin) => reference === referenceTo(pin)) ?? null);
}

/** Why a result has no changes against that other one, as what the other one is; `null` where it has. */
export function whyNotCompared(shown: Result, other: Result): string | null {
  if (roadsOf(shown) !== roadsOf(other)) return `over ${count(roadsOf(other), "road")}`;
  if (roadsOf(shown) === 1) return null;
  if (getAt(shown.scenario, SEED) !== getAt(other.scenario, SEED)) return "over roads of other seeds";
  return shown.coreVersion === other.coreVersion ? null : `computed by core ${other.coreVersion}`;
}
