/** A metric over a field, one curve for each strategy, and where each keeps a limit. */

import type { Solution } from "../../api/types";

export type Point = readonly [x: number, y: number];
export type Range = readonly [from: number, to: number];

/** What was driven, lowest value first; a value without the metric is left out. */
export const curveOf = (tried: Solution["tried"]): readonly Point[] =>
  tried
    .flatMap(({ value, metric_value }): readonly Point[] => (metric_value === null ? [] : [[value, metric_value]]))
    .sort(([a], [b]) => a - b);

/** Where the straight line between two points has that height. */
const at = ([x0, y0]: Point, [x1, y1]: Point, limit: number) => x0 + ((limit - y0) / (y1 - y0)) * (x1 - x0);

/** Where the curve, straight between its points, is at or below the limit. */
export function rangesBelow(curve: readonly Point[], limit: number): readonly Range[] {
  const ranges: Range[] = [];
  let start: number | null = null;
  for (const [index, point] of curve.entries()) {
    const [x, y] = point;
    const before = curve[index - 1];
    if (y <= limit && start === null) start = before ? at(before, point, limit) : x;
    if (y > limit && start !== null && before) {
      ranges.push([start, at(before, point, limit)]);
      start = null;
    }
  }
  const last = curve.at(-1);
  return start === null || !last ? ranges : [...ranges, [start, last[0]]];
}

/** Where the curve crosses the limit. */
export const crossings = (curve: readonly Point[], limit: number): readonly number[] =>
  rangesBelow(curve, limit)
    .flat()
    .filter((x) => x !== curve[0]?.[0] && x !== curve.at(-1)?.[0]);

/** `up to about 31 km/h`, or why there is no such value. */
export function rangesText(curve: readonly Point[], limit: number, textOf: (value: number) => string): string {
  const ranges = rangesBelow(curve, limit);
  const [[first] = [0], [last] = [0]] = [curve[0], curve.at(-1)];
  if (curve.length < 2) return "could not be driven";
  if (ranges.length === 0) return "above the limit everywhere";
  return ranges
    .map(([from, to]) => {
      if (from === first && to === last) return "below the limit everywhere";
      if (from === first) return `up to about ${textOf(to)}`;
      return to === last ? `from about ${textOf(from)} on` : `from about ${textOf(from)} to ${textOf(to)}`;
    })
    .join(", and ");
}

/** The ends of an axis on which all curves and the limit are seen. */
export function extentOf(curves: readonly (readonly Point[])[]): { readonly x: Range; readonly y: Range } {
  const points = curves.flat();
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const low = Math.min(0, ...ys);
  return { x: [Math.min(...xs), Math.max(...xs)], y: [low, low + 1.08 * (Math.max(...ys) - low) || 1] };
}

/** Half as high as the highest curve: where a limit that nobody has typed yet stands. */
export const openingLimit = (curves: readonly (readonly Point[])[]): number => extentOf(curves).y[1] / 2;
