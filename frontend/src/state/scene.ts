/** What is on stage: the shown answer, through the eyes of the current view. */

import type { SeriesByStrategy, Strategy, StrategyId, Summary } from "../api/types";
import type { Axis, View, Zoom } from "./address";
import type { Shown } from "./shown";

export interface Scene {
  readonly shown: Shown;
  /** Strategies that are on and have a result, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly ids: readonly StrategyId[];
  readonly summaries: Readonly<Record<StrategyId, Summary>>;
  readonly series: SeriesByStrategy;
  readonly baseline: StrategyId | null;
  readonly axis: Axis;
  readonly whole: Zoom;
  readonly range: Zoom;
}

export const axisKey = (axis: Axis) => (axis === "distance" ? "position" : "time");

function wholeRange(series: SeriesByStrategy, ids: readonly StrategyId[], axis: Axis): Zoom {
  const ends = ids.map((id) => series[id]?.[axisKey(axis)]?.at(-1) ?? 0);
  return [0, Math.max(1e-3, ...ends)];
}

export function makeScene(shown: Shown, catalogue: readonly Strategy[], selected: readonly StrategyId[], view: View): Scene {
  const strategies = catalogue.filter(({ id }) => selected.includes(id) && id in shown.summaries);
  const ids = strategies.map(({ id }) => id);
  const whole = wholeRange(shown.series, ids, view.axis);
  const zoom = view.zoom && view.zoom[0] < whole[1] ? view.zoom : null;
  return {
    shown,
    strategies,
    ids,
    summaries: shown.summaries,
    series: shown.series,
    baseline: view.baseline in shown.summaries ? view.baseline : (ids.at(-1) ?? null),
    axis: view.axis,
    whole,
    range: zoom ?? whole,
  };
}
