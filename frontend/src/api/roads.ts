/** Runs over several roads: plain numbers like every run's (the means), and beside them what the roads say of them. */

import type { Failure, Interval, OverRoads, RoadsAnswer, Run, RunAnswer, StrategyId, Summary } from "./types";

type Means = Pick<Summary, "metrics" | "comfort">;

function mapped<Value, Result>(
  entries: Readonly<Record<string, Value>>,
  change: (value: Value) => Result,
): Record<string, Result> {
  return Object.fromEntries(Object.entries(entries).map(([key, value]) => [key, change(value)]));
}

const mean = (interval: Interval) => interval.mean;

function meansOf({ metrics, comfort }: OverRoads["estimates"][StrategyId]): Means {
  return {
    metrics: mapped(metrics, (signals) => mapped(signals, ({ rms, peak }) => ({ rms: rms.mean, peak: peak.mean }))),
    comfort: mapped(comfort, mean),
  };
}

/** A run as the page has it. */
export function readRun(answer: RunAnswer | RoadsAnswer): Run {
  if (!("roads" in answer)) return { ...answer, over: null };
  const { roads, baseline, changes, strategies, ...run } = answer;
  const estimates: Record<StrategyId, OverRoads["estimates"][StrategyId]> = {};
  const means: Record<StrategyId, Summary | Failure> = {};
  for (const [id, entry] of Object.entries(strategies)) {
    if (entry.status === "ok") {
      const { metrics, comfort } = entry;
      estimates[id] = { metrics, comfort };
      means[id] = { ...entry, ...meansOf(entry) };
    } else means[id] = entry;
  }
  return { ...run, strategies: means, over: { roads, baseline, changes, estimates } };
}
