/** How the page writes the paper's numbers, as printed, and ours. */

import { formatFixed } from "../../units/format";

/** Digits after the point of a number written in full; what conversion to another unit adds far behind is not there. */
const decimalsOf = (value: number) => /\.(\d+)$/.exec(String(Number(value.toPrecision(10))))?.[1]?.length ?? 0;

/** A printed absolute in the unit shown, every digit of it; below ten the paper prints two decimals. */
export function printedValue(value: number, scale: number): string {
  const shown = value * scale;
  return formatFixed(shown, Math.max(decimalsOf(shown), Math.abs(shown) < 10 ? 2 : 0));
}

/** A printed change with its sign and every digit of it. */
export function printedChange(percent: number): string {
  const digits = formatFixed(Math.abs(percent), Math.max(1, decimalsOf(percent)));
  return `${percent < 0 ? "−" : percent > 0 ? "+" : "±"}${digits}\u2009%`;
}

/** The server's plain text with a real minus, apostrophe and spaces that do not break before a unit. */
export const typeset = (text: string) =>
  text
    .replace(/(^|[\s([])-(?=\d)/g, "$1−")
    .replace(/(\d) %/g, "$1\u00a0%")
    .replace(/(\w)'(?=\w)/g, "$1’");

type Ends = readonly number[];

/** `± 2.1`, in percent points, or both ends where they are not as far away. */
export function spreadOf(value: number, [low = NaN, high = NaN]: Ends): string {
  const [below, above] = [value - low, high - value];
  if (!Number.isFinite(below + above)) return "";
  return Math.abs(below - above) < 0.05
    ? `±\u2009${formatFixed(above, 1)}`
    : `${formatFixed(low, 1)} to ${formatFixed(high, 1)}`;
}
