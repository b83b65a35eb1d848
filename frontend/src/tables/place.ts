/** Where a number stands in a result, and what several roads say of it. */

import type { Interval, StrategyId, Summary } from "../api/types";
import type { Shown } from "../state/shown";

export type Place =
  | { readonly window: "rough_road" | "bump" | "whole"; readonly signal: string; readonly statistic: "rms" | "peak" }
  | { readonly comfort: string }
  | { readonly run: string };

export function valueAt(summary: Summary | undefined, place: Place): number | null | undefined {
  if ("comfort" in place) return summary?.comfort[place.comfort];
  if ("run" in place) return place.run === "travel_time" ? summary?.travel_time : summary?.arrival_speed_kmh;
  return summary?.metrics[place.window]?.[place.signal]?.[place.statistic];
}

/** The mean's interval over several roads. */
export function intervalAt({ over }: Shown, strategy: StrategyId, place: Place): Interval | undefined {
  const estimates = over?.estimates[strategy];
  if ("run" in place) return undefined;
  if ("comfort" in place) return estimates?.comfort[place.comfort];
  return estimates?.metrics[place.window]?.[place.signal]?.[place.statistic];
}

/** The paired change against that baseline: `null` against zero, undefined where the run has none. */
export function pairedAt({ over }: Shown, strategy: StrategyId, baseline: StrategyId | null, place: Place): Interval | null | undefined {
  const changes = over?.baseline === baseline ? over.changes[strategy] : undefined;
  if ("run" in place) return undefined;
  if ("comfort" in place) return changes?.comfort[place.comfort];
  return changes?.[place.window][place.signal]?.[place.statistic];
}
