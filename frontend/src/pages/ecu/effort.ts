/** Memory, times and losses of a controller as a person reads them. */

import { formatInput } from "../../units/format";

const short = (value: number) => formatInput(Number(value.toPrecision(3)));

export const kilobytes = (bytes: number): string => `${short(bytes / 1024)}\u00a0KB`;

/** `8.24 ms`, `140 µs`, `1.2 s`. */
export function formatTime(seconds: number): string {
  if (seconds < 1e-3) return `${short(seconds * 1e6)}\u00a0µs`;
  return seconds < 1 ? `${short(seconds * 1e3)}\u00a0ms` : `${short(seconds)}\u00a0s`;
}

/** `2.4 – 3.1`, and once where both ends read the same. */
export function formatEnds(
  { least, most }: { readonly least: number; readonly most: number },
  format: (value: number) => string,
): string {
  const [low, high] = [format(least), format(most)];
  return low === high ? low : `${low} – ${high}`;
}

type Changes = Readonly<Record<string, Readonly<Record<string, number | null>>>>;

/** The largest increase [%], over all figures. */
export const largestLoss = (changes: Changes): number =>
  Math.max(...Object.values(changes).flatMap((window) => Object.values(window).filter((change) => change !== null)));
