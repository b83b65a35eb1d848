/** Where the numbers of a result stand. */

import type { Summary } from "../api/types";

/** Where a number stands in a result, and what several roads say of it. */
export interface WindowMetric {
  readonly window: "rough_road" | "bump" | "whole";
  readonly signal: string;
  readonly statistic: "rms" | "peak";
}

export type MetricPath = WindowMetric | { readonly comfort: string } | { readonly run: string };

/** `bump.body_acceleration.peak`, `comfort.weighted_rms` or `travel_time`: a batch's column as a metric. */
export function metricPath(key: string): MetricPath {
  const [first = "", signal, statistic] = key.split(".");
  if (statistic !== undefined) return { window: first, signal, statistic } as WindowMetric;
  return first === "comfort" ? { comfort: signal ?? "" } : { run: key };
}

/** That column of a metric. */
export function metricName(metric: MetricPath): string {
  if ("comfort" in metric) return `comfort.${metric.comfort}`;
  return "run" in metric ? metric.run : `${metric.window}.${metric.signal}.${metric.statistic}`;
}

export function valueAt(summary: Summary | undefined, metric: MetricPath): number | null | undefined {
  if ("comfort" in metric) return summary?.comfort[metric.comfort];
  if ("run" in metric) return metric.run === "travel_time" ? summary?.travel_time : summary?.arrival_speed_kmh;
  return summary?.metrics[metric.window]?.[metric.signal]?.[metric.statistic];
}

/** What a summary has by a flat name, events included. */
export function figureNamed(summary: Summary | undefined, name: string) {
  const [, event] = /^events[.](.+)/.exec(name) ?? [];
  return event === undefined ? valueAt(summary, metricPath(name)) : summary?.events[event];
}

/** The same as a number; `null` where it has none. */
export function valueNamed(summary: Summary | undefined, name: string): number | null {
  const value = figureNamed(summary, name);
  return typeof value === "number" || typeof value === "boolean" ? Number(value) : null;
}
