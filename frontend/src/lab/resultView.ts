/** What is on stage: the shown answer, through the eyes of the current view. */

import type { SeriesByStrategy, Strategy, StrategyId, Summary } from "../api/types";
import type { Axis, View, ViewZoom, Zoom } from "./address";
import { referenceVariant, NOTHING_COMPARED, type Compared, type RoadPairedChanges, type Variant } from "./compare";
import type { Judged } from "./requirements";
import { isRecording } from "../lib/recording";
import type { Result } from "./result";

export interface ResultView {
  readonly shown: Result;
  /** Every strategy there is. */
  readonly catalogue: readonly Strategy[];
  /** Strategies that are on and have a result, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly ids: readonly StrategyId[];
  /** Why others that are on have no result. */
  readonly faults: Readonly<Record<StrategyId, string>>;
  readonly summaries: Readonly<Record<StrategyId, Summary>>;
  readonly series: SeriesByStrategy;
  readonly baseline: StrategyId | null;
  /** The state before the last edit. */
  readonly before: Variant | null;
  readonly pins: readonly Variant[];
  readonly roadPairedChanges: RoadPairedChanges;
  /** What changes are against, where that is not the baseline. */
  readonly reference: Variant | null;
  /** Plots show differences to what changes are against. */
  readonly differences: boolean;
  readonly judged: Judged;
  readonly axis: Axis;
  readonly zoom: ViewZoom;
  readonly whole: Zoom;
  /** The bump with some road around it; `null` where there is none. */
  readonly bump: Zoom | null;
  readonly range: Zoom;
}

export const axisKey = (axis: Axis) => (axis === "distance" ? "position" : "time");

function wholeRange(series: SeriesByStrategy, ids: readonly StrategyId[], axis: Axis): Zoom {
  const ends = ids.map((id) => series[id]?.[axisKey(axis)]?.at(-1) ?? 0);
  return [0, Math.max(1e-3, ...ends)];
}

export function makeResultView(
  shown: Result,
  catalogue: readonly Strategy[],
  selected: readonly StrategyId[],
  view: View,
  compared: Compared = NOTHING_COMPARED,
): ResultView {
  return withBaseline(partShown(shown, catalogue, selected, view), view, compared);
}

/** What is drawn, whatever it is compared with. */
export type PartShown = Omit<
  ResultView,
  "baseline" | "differences" | "judged" | "reference" | "roadPairedChanges" | keyof Compared
>;

export function partShown(
  shown: Result,
  catalogue: readonly Strategy[],
  selected: readonly StrategyId[],
  { axis, zoom }: Pick<View, "axis" | "zoom">,
): PartShown {
  const strategies = catalogue.filter(({ id }) => selected.includes(id) && id in shown.summaries);
  const ids = strategies.map(({ id }) => id);
  const whole = wholeRange(shown.series, ids, axis);
  const { summaries, series } = shown;
  const faults = Object.fromEntries(
    shown.failed.flatMap(({ strategy, message }) => (selected.includes(strategy) ? [[strategy, message]] : [])),
  );
  const bump = bumpRange(summaries, ids, axis, whole);
  const range = rangeOf(zoom, bump, whole);
  return { shown, catalogue, strategies, ids, faults, summaries, series, axis, zoom, whole, bump, range };
}

/**
 * What changes refer to: the strategy that was chosen, shown or hidden, or the service's choice where the run lacks that
 * one. A recorded drive stays it under a moving slider, too: nothing simulates it, and the exact run has it again.
 */
export function baselineOf(
  { source, summaries, failed, comparison }: Pick<Result, "source" | "summaries" | "failed" | "comparison">,
  chosen: StrategyId,
): StrategyId | null {
  const isThere = chosen in summaries || failed.some(({ strategy }) => strategy === chosen);
  return isThere || (source === "live" && isRecording(chosen)) ? chosen : (comparison?.baseline ?? null);
}

export function withBaseline(
  part: PartShown,
  { baseline, reference, differences }: Pick<View, "baseline" | "reference" | "differences">,
  compared: Compared,
  { roadPairedChanges = {}, judged = {} }: Partial<Pick<ResultView, "roadPairedChanges" | "judged">> = {},
): ResultView {
  return {
    ...part,
    baseline: baselineOf(part.shown, baseline),
    ...compared,
    roadPairedChanges,
    judged,
    reference: referenceVariant(compared, reference),
    differences,
  };
}

/** What is simulated of it: no recorded drive has a car to draw. */
export function simulatedPart(resultView: ResultView): ResultView {
  if (!resultView.ids.some(isRecording)) return resultView;
  const strategies = resultView.strategies.filter(({ id }) => !isRecording(id));
  return { ...resultView, strategies, ids: strategies.map(({ id }) => id) };
}

function rangeOf(zoom: ViewZoom, bump: Zoom | null, whole: Zoom): Zoom {
  if (zoom === "whole") return whole;
  return zoom && zoom[0] < whole[1] ? zoom : (bump ?? whole);
}

/** Parts of the bump's length that are shown before and behind it. */
const [BEFORE, BEHIND] = [0.6, 0.9];

export function bumpRange(
  summaries: ResultView["summaries"],
  ids: readonly StrategyId[],
  axis: Axis,
  [first, last]: Zoom = [-Infinity, Infinity],
): Zoom | null {
  const spans = ids.flatMap((id) => summaries[id]?.stages.find(({ stage }) => stage === "bump") ?? []);
  if (spans.length === 0) return null;
  const ends = spans.map((span) =>
    axis === "distance" ? [span.start_position, span.end_position] : [span.start_time, span.end_time],
  );
  const low = Math.min(...ends.map(([start = 0]) => start));
  const high = Math.max(...ends.map(([, end = 0]) => end));
  return [Math.max(first, low - BEFORE * (high - low)), Math.min(last, high + BEHIND * (high - low))];
}
