/** Memory, times and losses of a controller as a person reads them. */

import { formatNumber } from "../units/format";

export const kilobytes = (bytes: number): string => `${formatNumber(bytes / 1024)}\u00a0KB`;

/** `8.2 ms`, `140 µs`, `1.2 s`. */
export function formatTime(seconds: number): string {
  if (seconds < 1e-3) return `${formatNumber(seconds * 1e6)}\u00a0µs`;
  return seconds < 1 ? `${formatNumber(seconds * 1e3)}\u00a0ms` : `${formatNumber(seconds)}\u00a0s`;
}

type Changes = Readonly<Record<string, Readonly<Record<string, number | null>>>>;

/** The change that is furthest up [%], over all figures. */
export const largestLoss = (changes: Changes): number =>
  Math.max(...Object.values(changes).flatMap((window) => Object.values(window).filter((change) => change !== null)));
