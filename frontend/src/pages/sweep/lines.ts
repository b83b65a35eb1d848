/** Points of a sweep that differ in one field only, as lines. */

import type { StrategyId } from "../../api/types";
import { cell, type Columns, type Points } from "../../features/sweep/table";

/** A strategy's lines one after the other, with a gap (`null`) between them. */
export interface Lines {
  readonly strategy: StrategyId;
  readonly x: readonly (number | string | null)[];
  readonly y: readonly (number | null)[];
  /** Where each line ends, and which of the others' values it has. */
  readonly ends: readonly LineEnd[];
}

export interface LineEnd {
  readonly x: number | string;
  readonly y: number;
  readonly row: number;
}

/** More lines than these are a tangle. */
const MOST = 40;

/** Joins the points that are equal in the `others`, the swept fields that are not x; none where there are too many. */
export function linesOf(columns: Columns, points: readonly Points[], others: readonly string[]): readonly Lines[] {
  const groups = points.map(({ rows }) => {
    const groups = new Map<string, number[]>();
    rows.forEach((row, index) => {
      const key = JSON.stringify(others.map((name) => cell(columns, name, row)));
      const group = groups.get(key);
      if (group) group.push(index);
      else groups.set(key, [index]);
    });
    return [...groups.values()].filter(({ length }) => length >= 2);
  });
  const rowsAt = (line: number) => points[line]?.rows ?? [];
  if (groups.reduce((sum, { length }) => sum + length, 0) > MOST) return [];
  return points.map(({ strategy, x, y }, line) => ({
    strategy,
    x: (groups[line] ?? []).flatMap((group) => [...group.map((index) => x[index] ?? null), null]),
    y: (groups[line] ?? []).flatMap((group) => [...group.map((index) => y[index] ?? null), null]),
    ends: (groups[line] ?? []).flatMap((group) => {
      const index = group.at(-1) ?? 0;
      const [atX, atY, row] = [x[index], y[index], rowsAt(line)[index]];
      return atX === undefined || atY === undefined || row === undefined ? [] : [{ x: atX, y: atY, row }];
    }),
  }));
}

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
