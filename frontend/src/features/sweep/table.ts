/** A batch's rows as columns: which are shown, in which order, and which is best. */

import type { BatchTable, StrategyId } from "../../api/types";
import { inOrder } from "../../lib/order";

export type Cell = BatchTable["columns"][string][number] | undefined;
export type Columns = BatchTable["columns"];

export const cell = (columns: Columns, name: string, row: number): Cell => columns[name]?.[row];

export function rowsOf(columns: Columns, keep: (row: number) => boolean): readonly number[] {
  return (columns.run ?? []).flatMap((_, row) => (keep(row) ? [row] : []));
}

/** The row with the lowest value among those; `null` where none has one. */
export function lowest(columns: Columns, rows: readonly number[], column: string): number | null {
  let best: number | null = null;
  let least = Infinity;
  for (const row of rows) {
    const value = cell(columns, column, row);
    if (typeof value === "number" && value < least) {
      least = value;
      best = row;
    }
  }
  return best;
}

export interface Points {
  readonly strategy: StrategyId;
  readonly rows: readonly number[];
  readonly x: readonly (number | string)[];
  readonly y: readonly number[];
}

const asAxisValue = (value: Cell): number | string | null =>
  typeof value === "number" || typeof value === "string" ? value : Array.isArray(value) ? value.join(", ") : null;

/** What a plot shows: for each strategy the rows that have both values, in ascending x. */
export function pointsOf(
  columns: Columns,
  strategies: readonly StrategyId[],
  x: string,
  y: string,
  scale: number,
  xScale = 1,
): readonly Points[] {
  return strategies.map((strategy) => {
    const rows = inOrder(
      rowsOf(
        columns,
        (row) =>
          cell(columns, "strategy", row) === strategy &&
          typeof cell(columns, y, row) === "number" &&
          asAxisValue(cell(columns, x, row)) !== null,
      ),
      (row) => cell(columns, x, row),
    );
    return {
      strategy,
      rows,
      x: rows.map((row) => {
        const value = asAxisValue(cell(columns, x, row)) ?? "";
        return typeof value === "number" ? value * xScale : value;
      }),
      y: rows.map((row) => Number(cell(columns, y, row)) * scale),
    };
  });
}
