/** Curves as differences: each strategy's values less those of what changes are against, at the same place. */

import { isExtreme, type Series } from "../api/decode";
import type { SeriesByStrategy, StrategyId, Summary } from "../api/types";
import type { Axis } from "../state/address";
import { axisKey, type Scene } from "../state/scene";
import type { FigureInput } from "./figure";
import type { Numbers } from "./plotly";

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

/** Of those strategies that both have. */
function differencesOf(series: SeriesByStrategy, other: SeriesByStrategy, axis: Axis): SeriesByStrategy {
  return Object.fromEntries(
    Object.entries(series).flatMap(([id, own]) => {
      const subtracted = other[id];
      return subtracted ? [[id, difference(own, subtracted, axis)]] : [];
    }),
  );
}

/** By strategy what its curves are compared with: the same one of another variant, or the baseline. */
function seriesAgainst({ against, baseline, ids }: Pick<Scene, "against" | "baseline" | "ids">, own: SeriesByStrategy, ofAgainst: SeriesByStrategy): SeriesByStrategy {
  if (against !== null) return ofAgainst;
  const base = baseline === null ? undefined : own[baseline];
  return base ? Object.fromEntries(ids.map((id) => [id, base])) : {};
}

/** A difference has no limits, static loads or targets of its own. */
const withoutReferences = (summaries: Readonly<Record<StrategyId, Summary>>): Readonly<Record<StrategyId, Summary>> =>
  Object.fromEntries(Object.entries(summaries).map(([id, summary]) => [id, { ...summary, reference: {} }]));

type Drawn = Pick<FigureInput, "series" | "driven" | "summaries">;

/** What is drawn of a scene: the curves themselves, or what they differ by from what changes are against. */
export function drawnOf(scene: Pick<Scene, "differences" | "against" | "baseline" | "ids" | "axis" | "summaries">, own: SeriesByStrategy, ofAgainst: SeriesByStrategy): Drawn {
  if (!scene.differences) return { series: own, driven: own, summaries: scene.summaries };
  const series = differencesOf(own, seriesAgainst(scene, own, ofAgainst), scene.axis);
  return { series, driven: own, summaries: withoutReferences(scene.summaries) };
}

/** What is taken away, in words. */
export const subtrahend = ({ against, baseline, catalogue }: Scene): string =>
  against?.name ?? catalogue.find(({ id }) => id === baseline)?.label ?? "";
