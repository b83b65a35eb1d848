/** Where the bars of the three shares begin and end. Shares may be negative or beyond 100 %. Pure. */

import type { Attribution } from "../../api/types";

export const PARTS = [
  { part: "speed", label: "Lower speed" },
  { part: "preview", label: "Preview" },
  { part: "switching", label: "Weight switching" },
] as const;

export type Part = (typeof PARTS)[number]["part"];
export type Share = Attribution["shares"][number];

export interface Segment {
  readonly part: Part;
  readonly from: number;
  readonly to: number;
}

/** What adds stacks up to the right of zero, what takes away to the left of it [%]. */
export function segmentsOf(share: Share): readonly Segment[] {
  let [up, down] = [0, 0];
  return PARTS.map(({ part }) => {
    const size = share[part];
    const from = size >= 0 ? up : down;
    if (size >= 0) up += size;
    else down += size;
    return size >= 0 ? { part, from, to: from + size } : { part, from: from + size, to: from };
  });
}

/** One scale for every bar: from the least to the greatest end, 0 and 100 % always in it. */
export function scaleOf(shares: readonly Share[]): readonly [number, number] {
  const ends = shares.flatMap((share) => segmentsOf(share).flatMap(({ from, to }) => [from, to]));
  return [Math.min(0, ...ends), Math.max(100, ...ends)];
}
