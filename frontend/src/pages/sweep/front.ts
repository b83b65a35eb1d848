/** The runs that no other one betters in both of two metrics; less is better. */

import type { Points } from "../../features/sweep/table";

interface Member {
  readonly row: number;
  readonly x: number;
  readonly y: number;
}

/** In ascending x, so in descending y; of runs alike the first. */
export function frontOf(points: readonly Points[]): readonly Member[] {
  const all = points.flatMap(({ rows, x, y }) =>
    rows.map((row, index): Member => ({ row, x: Number(x[index]), y: y[index] ?? NaN })),
  );
  let least = Infinity;
  return all
    .sort((a, b) => a.x - b.x || a.y - b.y || a.row - b.row)
    .filter(({ y }) => {
      if (!(y < least)) return false;
      least = y;
      return true;
    });
}
