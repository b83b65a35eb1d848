/** How sure a mean over roads is: 95 % intervals, as sim_core/comparison/intervals.py has them. */

const NORMAL = 1.959963984540054; // 97.5 % of the normal distribution lie below

/** Below which 97.5 % of Student's t lie; from three degrees of freedom on by Abramowitz and Stegun, 26.7.5, to 0.2 %. */
export function studentQuantile(freedom: number): number {
  if (freedom === 1) return Math.tan(0.475 * Math.PI);
  if (freedom === 2) return 0.95 / Math.sqrt(2 * 0.975 * 0.025);
  const z = NORMAL;
  return [
    (z ** 3 + z) / 4,
    (5 * z ** 5 + 16 * z ** 3 + 3 * z) / 96,
    (3 * z ** 7 + 19 * z ** 5 + 17 * z ** 3 - 15 * z) / 384,
    (79 * z ** 9 + 776 * z ** 7 + 1482 * z ** 5 - 1920 * z ** 3 - 945 * z) / 92_160,
  ].reduce((sum, term, order) => sum + term / freedom ** (order + 1), z);
}

export const mean = (values: readonly number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

/**
 * Change of the mean of `values` against that of `bases` [%], of the same roads in the same order, and half the width of
 * its interval, by linearisation (Cochran 1977, Sampling Techniques, 6.4). `null` without two roads or against zero.
 */
export function pairedChangeOf(
  values: readonly number[],
  bases: readonly number[],
): { readonly percent: number; readonly half: number } | null {
  const [base, count] = [mean(bases), values.length];
  if (count < 2 || base === 0) return null;
  const ratio = mean(values) / base;
  const squares = values.map((value, road) => ((value - ratio * (bases[road] ?? 0)) / base) ** 2);
  const half = studentQuantile(count - 1) * Math.sqrt(mean(squares) / (count - 1));
  return { percent: 100 * (ratio - 1), half: 100 * half };
}
