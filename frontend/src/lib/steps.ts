/** Round steps: 1, 2 or 5 × 10ⁿ. */

const DUST = 1e-9;

/** The largest that is not above `value`. */
export function stepBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value) + DUST);
  return ([5, 2].find((digit) => digit * power <= value * (1 + DUST)) ?? 1) * power;
}

/** The smallest that is not below `value`. */
export function stepAbove(value: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(value, Number.MIN_VALUE)));
  return ([1, 2, 5].find((digit) => digit * power >= value * (1 - DUST)) ?? 10) * power;
}

/** Such a range is better divided by ratios than by differences. */
export const spansDecades = (low: number, high: number): boolean => low > 0 && high / low >= 100;
