/** Finding things in ascending samples. */

export type Numbers = Float32Array;

/** Index of the first sample at or after `x`; the length where there is none. */
function firstAtOrAfter(samples: Numbers, x: number): number {
  let low = 0;
  let high = samples.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if ((samples[middle] ?? Infinity) < x) low = middle + 1;
    else high = middle;
  }
  return low;
}

function finite(value: number | null): number | null {
  return Number.isFinite(value) ? value : null;
}

/** Linear interpolation of `values` over ascending `samples`; `null` outside them, and where a value is missing (NaN). */
export function valueAt(samples: Numbers, values: Numbers, x: number): number | null {
  const first = samples[0];
  const last = samples.at(-1);
  if (first === undefined || last === undefined || x < first || x > last) return null;
  const right = firstAtOrAfter(samples, x);
  const [x1, y1] = [samples[right] ?? last, values[right] ?? null];
  if (right === 0 || x === x1 || y1 === null) return finite(y1);
  const [x0, y0] = [samples[right - 1] ?? x1, values[right - 1] ?? y1];
  return finite(y0 + ((y1 - y0) * (x - x0)) / (x1 - x0));
}

/** Half-open index range that covers [low, high] and one sample more on either side. */
export function covering(samples: Numbers, low: number, high: number): readonly [number, number] {
  return [Math.max(0, firstAtOrAfter(samples, low) - 1), Math.min(samples.length, firstAtOrAfter(samples, high) + 1)];
}

export function extent(values: Numbers): readonly [number, number] | null {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : null;
}

/** Stretches of x where `values` lies below `limit`. */
export function stretchesBelow(
  samples: Numbers,
  values: Numbers,
  limit: number,
): readonly (readonly [number, number])[] {
  const spans: (readonly [number, number])[] = [];
  let start: number | null = null;
  for (let i = 0; i < samples.length; i++) {
    const below = (values[i] ?? 0) < limit;
    const x = samples[i] ?? 0;
    if (below && start === null) start = x;
    if (!below && start !== null) {
      spans.push([start, x]);
      start = null;
    }
  }
  if (start !== null) spans.push([start, samples.at(-1) ?? start]);
  return spans;
}
