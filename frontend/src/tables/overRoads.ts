/** What several roads say of a figure: its mean's interval, and its paired change against the baseline shown. */

import type { Interval, StrategyId } from "../api/types";
import type { Scene } from "../state/scene";

export interface RoadsStatistics {
  readonly interval: Interval | undefined;
  /** `null` against zero, undefined where there is none against that baseline. */
  readonly change: Interval | null | undefined;
}

type Place = { readonly window: "rough_road" | "bump" | "whole"; readonly signal: string; readonly statistic: "rms" | "peak" } | { readonly comfort: string };

export function statisticsOf({ shown: { over }, baseline }: Scene, strategy: StrategyId, place: Place): RoadsStatistics {
  const estimates = over?.estimates[strategy];
  const changes = over?.baseline === baseline ? over.changes[strategy] : undefined;
  if ("comfort" in place) return { interval: estimates?.comfort[place.comfort], change: changes?.comfort[place.comfort] };
  const { window, signal, statistic } = place;
  return { interval: estimates?.metrics[window]?.[signal]?.[statistic], change: changes?.[window][signal]?.[statistic] };
}
