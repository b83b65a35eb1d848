/** Where a number stands in a result, and what several roads say of it. */

import type { Interval, StrategyId, Summary } from "../api/types";
import type { Shown } from "../state/shown";

export type MetricPath =
  | { readonly window: "rough_road" | "bump" | "whole"; readonly signal: string; readonly statistic: "rms" | "peak" }
  | { readonly comfort: string }
  | { readonly run: string };

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

/** The paired change against that baseline: `null` against zero, undefined where the run has none. */
export function pairedAt({ over }: Shown, strategy: StrategyId, baseline: StrategyId | null, metric: MetricPath): Interval | null | undefined {
  const changes = over?.baseline === baseline ? over.changes[strategy] : undefined;
  if ("run" in metric) return undefined;
  if ("comfort" in metric) return changes?.comfort[metric.comfort];
  return changes?.[metric.window][metric.signal]?.[metric.statistic];
}
