/** Curves as differences: each strategy's values less those of what changes are against, at the same place. */

import { isExtreme, type Series } from "../api/decode";
import type { SeriesByStrategy, StrategyId, Summary } from "../api/types";
import type { Axis, Zoom } from "../lab/address";
import { axisKey, type PartShown, type ResultView } from "../lab/resultView";
import type { Curves, FigureInput } from "./curves";
import { type Numbers, covering } from "../lib/samples";

const COORDINATES = ["time", "position"];

/** `values` over ascending `samples`, read at ascending places; its end values outside. */
function resampled(samples: Numbers, values: Numbers, places: Numbers): Numbers {
  const result = new Float32Array(places.length);
  let right = 0;
  for (let i = 0; i < places.length; i++) {
    const x = places[i] ?? 0;
    while (right < samples.length - 1 && (samples[right] ?? 0) < x) right++;
    const left = Math.max(0, right - 1);
    const [x0, x1, y0, y1] = [samples[left] ?? 0, samples[right] ?? 0, values[left] ?? 0, values[right] ?? 0];
    const part = x1 > x0 ? Math.min(1, Math.max(0, (x - x0) / (x1 - x0))) : 1;
    result[i] = y0 + part * (y1 - y0);
  }
  return result;
}

/** Around the middle of a range: how far no sample of the run is left out. Those of a whole run lie evenly in time. */
function wholePart(series: Series, axis: Axis, [low, high]: Zoom): Zoom {
  const [x, { time }] = [series[axisKey(axis)], series];
  if (!x || !time) return [-Infinity, Infinity];
  const step = (index: number) => (time[index] ?? NaN) - (time[index - 1] ?? NaN);
  let least = Infinity;
  for (let i = 1; i < time.length; i++) least = Math.min(least, step(i));
  let [, to] = covering(x, (low + high) / 2, (low + high) / 2);
  let from = to - 1;
  const isNext = (index: number) => step(index) <= MOST_UNEVEN * least;
  while (from > 0 && isNext(from)) from--;
  while (to < x.length && isNext(to)) to++;
  return [x[from] ?? low, x[to - 1] ?? high];
}

/** Where both curves have all their samples; where not, a difference would be that of their samples. */
function commonPart(one: Series, other: Series, axis: Axis, range: Zoom): Zoom {
  const [own, subtracted] = [wholePart(one, axis, range), wholePart(other, axis, range)];
  return [Math.max(own[0], subtracted[0]), Math.min(own[1], subtracted[1])];
}

function within(series: Series, axis: Axis, [low, high]: Zoom): Series {
  const inside = (series[axisKey(axis)] ?? new Float32Array()).map((x) => Number(x >= low && x <= high));
  return Object.fromEntries(
    Object.entries(series).map(([key, values]) => [key, values.filter((_, index) => inside[index] === 1)]),
  );
}

/** Times in single precision are uneven by less. */
const MOST_UNEVEN = 1.5;

/** Of the part that is shown and of what lies on either side of it. */
const [PARTS_SHOWN, PARTS_BESIDE] = [400, 20];

/** As many samples as a screen shows: of each small part of the axis every signal's smallest and largest value. */
function thinned(series: Series, axis: Axis, [low, high]: Zoom): Series {
  const x = series[axisKey(axis)];
  if (!x || x.length <= PARTS_SHOWN) return series;
  const [from, to] = covering(x, low, high);
  const indices = new Set([0, from, to - 1, x.length - 1]);
  const keep = (start: number, end: number, parts: number) => {
    for (const [key, values] of Object.entries(series)) {
      if (COORDINATES.includes(key)) continue;
      for (let part = 0; part < parts; part++) {
        const [first, last] = [part, part + 1].map((edge) => start + Math.round(((end - start) * edge) / parts)) as [
          number,
          number,
        ];
        let [bottom, top] = [first, first];
        for (let i = first; i < last; i++) {
          if ((values[i] ?? 0) < (values[bottom] ?? 0)) bottom = i;
          if ((values[i] ?? 0) > (values[top] ?? 0)) top = i;
        }
        if (last > first) indices.add(bottom).add(top);
      }
    }
  };
  keep(0, from, PARTS_BESIDE);
  keep(from, to, PARTS_SHOWN);
  keep(to, x.length, PARTS_BESIDE);
  const places = Uint32Array.from(indices).sort();
  return Object.fromEntries(
    Object.entries(series).map(([key, values]) => [key, Float32Array.from(places, (place) => values[place] ?? 0)]),
  );
}

function difference(one: Series, other: Series, axis: Axis): Series {
  const [places, samples] = [one[axisKey(axis)], other[axisKey(axis)]];
  if (!places || !samples) return {};
  const less = (key: string, values: Numbers): Numbers => {
    const subtracted = other[key];
    if (COORDINATES.includes(key) || !subtracted) return values;
    const at = resampled(samples, subtracted, places);
    return values.map((value, index) => value - (at[index] ?? 0));
  };
  // Extremes over roads are those of different roads: the means alone have a difference.
  const keys = Object.keys(one).filter((key) => !isExtreme(key));
  return Object.fromEntries(keys.map((key) => [key, less(key, one[key] ?? places)]));
}

/** Of those strategies that both have: subtracted with all samples, thinned for the screen afterwards. */
function differencesOf(series: SeriesByStrategy, other: SeriesByStrategy, axis: Axis, range: Zoom): SeriesByStrategy {
  return Object.fromEntries(
    Object.entries(series).flatMap(([id, own]) => {
      const subtracted = other[id];
      if (!subtracted) return [];
      const whole = within(difference(own, subtracted, axis), axis, commonPart(own, subtracted, axis, range));
      return [[id, thinned(whole, axis, range)]];
    }),
  );
}

/** By strategy what its curves are compared with: the same one of another variant, or the baseline. */
function seriesAgainst(
  { reference, baseline, ids }: Pick<ResultView, "reference" | "baseline" | "ids">,
  own: SeriesByStrategy,
  ofAgainst: SeriesByStrategy,
): SeriesByStrategy {
  if (reference !== null) return ofAgainst;
  const base = baseline === null ? undefined : own[baseline];
  return base ? Object.fromEntries(ids.map((id) => [id, base])) : {};
}

/** A difference has no limits, static loads or targets of its own. */
const withoutReferences = (summaries: Readonly<Record<StrategyId, Summary>>): Readonly<Record<StrategyId, Summary>> =>
  Object.fromEntries(Object.entries(summaries).map(([id, summary]) => [id, { ...summary, reference: {} }]));

type Drawn = Pick<FigureInput, "series" | "sourceSeries" | "summaries">;

/** What is drawn of a result view: the curves themselves, or what they differ by from what changes are against. */
export function drawnOf(
  resultView: Pick<ResultView, "differences" | "reference" | "baseline" | "ids" | "axis" | "range" | "summaries">,
  own: SeriesByStrategy,
  ofAgainst: SeriesByStrategy,
): Drawn {
  if (!resultView.differences) return { series: own, sourceSeries: own, summaries: resultView.summaries };
  const series = differencesOf(own, seriesAgainst(resultView, own, ofAgainst), resultView.axis, resultView.range);
  return { series, sourceSeries: own, summaries: withoutReferences(resultView.summaries) };
}

/** What of a result view is drawn; the series are its own, or finer. */
export function curvesOf(
  resultView: Omit<PartShown, "whole"> & Pick<ResultView, "differences" | "reference" | "baseline">,
  own: SeriesByStrategy,
  ofAgainst: SeriesByStrategy,
): Curves {
  const { strategies, axis, range, shown } = resultView;
  const { source, runId, coreVersion } = shown;
  return {
    ...drawnOf(resultView, own, ofAgainst),
    ...{ strategies, axis, range, live: source === "live", runId, coreVersion },
  };
}

/** What is taken away, in words. */
export const subtrahend = ({ reference, baseline, catalogue }: ResultView): string =>
  reference?.name ?? catalogue.find(({ id }) => id === baseline)?.label ?? "";
