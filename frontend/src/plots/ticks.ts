/** Where an axis has its marks and what they say: one definition for plotly and for the canvas. */

type Range = readonly [number, number];

export interface Ticks {
  readonly values: readonly number[];
  readonly texts: readonly string[];
}

/** At most about `most` multiples of 1, 2 or 5 × 10ⁿ; the last one carries the unit. */
export function ticksFor([low, high]: Range, most: number, suffix = ""): Ticks {
  const step = stepFor((high - low) / most);
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.max(0, Math.floor(high / step + 1e-9) - first + 1);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const values = Array.from({ length: count }, (_, index) => (first + index) * step);
  const texts = values.map((value, index) => labelOf(value, decimals) + (index === count - 1 ? suffix : ""));
  return { values, texts };
}

/** The smallest 1, 2 or 5 × 10ⁿ that is not below. */
function stepFor(least: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(least, Number.MIN_VALUE)));
  return ([1, 2, 5].find((digit) => digit * power >= least * (1 - 1e-9)) ?? 10) * power;
}

function labelOf(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? "0" : text.replace("-", "−");
}
