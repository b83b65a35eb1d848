/** Where a number stands in a result, and what several roads say of it. */

import type { Interval, OverRoads, Strategy, StrategyId, Summary } from "../../api/types";
import type { Shown } from "../../lab/result";

export interface WindowMetric {
  readonly window: "rough_road" | "bump" | "whole";
  readonly signal: string;
  readonly statistic: "rms" | "peak";
}

export type MetricPath = WindowMetric | { readonly comfort: string } | { readonly run: string };

export function valueAt(summary: Summary | undefined, metric: MetricPath): number | null | undefined {
  if ("comfort" in metric) return summary?.comfort[metric.comfort];
  if ("run" in metric) return metric.run === "travel_time" ? summary?.travel_time : summary?.arrival_speed_kmh;
  return summary?.metrics[metric.window]?.[metric.signal]?.[metric.statistic];
}

/** The mean's interval over several roads. */
export function intervalAt({ over }: Shown, strategy: StrategyId, metric: MetricPath): Interval | undefined {
  const estimates = over?.estimates[strategy];
  if ("run" in metric) return undefined;
  if ("comfort" in metric) return estimates?.comfort[metric.comfort];
  return estimates?.metrics[metric.window]?.[metric.signal]?.[metric.statistic];
}

/** The paired change: `null` against zero, undefined where there is none. */
export function pairedAt(
  changes: OverRoads["changes"] | undefined,
  strategy: StrategyId,
  metric: MetricPath,
): Interval | null | undefined {
  const own = changes?.[strategy];
  if ("run" in metric) return undefined;
  if ("comfort" in metric) return own?.comfort[metric.comfort];
  return own?.[metric.window][metric.signal]?.[metric.statistic];
}

/** Smaller changes [%] between these strategies may be one road's luck; times and speeds are the same on every road. */
export function luckOf(strategies: readonly Pick<Strategy, "one_road_resolution">[], metric: MetricPath): number {
  if ("run" in metric) return 0;
  const statistic = "comfort" in metric ? "rms" : metric.statistic;
  return Math.max(...strategies.map((strategy) => strategy.one_road_resolution[statistic] ?? 0));
}
