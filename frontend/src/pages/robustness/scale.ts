/** A scale from zero that ends on a round number. */

const STEPS = [1, 2, 2.5, 5, 10];

export function scaleTo(most: number): { readonly end: number; readonly ticks: readonly number[] } {
  if (!(most > 0)) return { end: 1, ticks: [0] };
  const rough = most / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (STEPS.find((each) => each * power >= rough * (1 - 1e-9)) ?? 10);
  const count = Math.ceil(most / step - 1e-9);
  // Multiples of the step, without the dust of binary fractions.
  const at = (index: number) => Number((index * step).toPrecision(10));
  return { end: at(count), ticks: Array.from({ length: count + 1 }, (_, index) => at(index)) };
}
