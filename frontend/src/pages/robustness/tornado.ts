/** Each field alone at both its ends: how far a figure moves from the scenario's own. */

import type { Batch, StrategyId } from "../../api/types";
import { cell, type Cell, type Columns } from "../../features/sweep/table";
import { sweepOf } from "./study";

export interface End {
  /** The table's row. */
  readonly row: number;
  /** The field's value there. */
  readonly at: Cell;
  readonly value: number;
}

export interface Bar {
  readonly field: Batch["fields"][number];
  readonly low: End | null;
  readonly high: End | null;
  /** How far the ends are from each other and from the nominal, at most. */
  readonly span: number;
}

export interface Tornado {
  readonly nominal: number;
  /** The widest first. */
  readonly bars: readonly Bar[];
}

/** `null` where the scenario itself has no such figure, or has not run yet. The list is the nominal, then a pair for each field. */
export function tornadoOf(batch: Batch, columns: Columns, strategy: StrategyId, figure: string): Tornado | null {
  const rows = (columns.run ?? []).flatMap((_, row) => (cell(columns, "strategy", row) === strategy ? [row] : []));
  const valueAt = (row: number | undefined): number | null => {
    const value = row === undefined ? null : cell(columns, figure, row);
    return typeof value === "number" ? value : null;
  };
  const nominal = valueAt(rows[0]);
  if (nominal === null) return null;
  const bars = batch.fields.map((field, index): Bar => {
    const [low = null, high = null] = [1, 2].map((step): End | null => {
      const row = rows[2 * index + step];
      const value = valueAt(row);
      return row === undefined || value === null ? null : { row, at: cell(columns, field.name, row), value };
    });
    const values = [nominal, ...[low, high].flatMap((end) => (end ? [end.value] : []))];
    return { field, low, high, span: Math.max(...values) - Math.min(...values) };
  });
  return { nominal, bars: [...bars].sort((a, b) => b.span - a.span) };
}

/** It is a study of this kind: the scenario itself, then two points for each field. */
export function isOneByOne(batch: Batch): boolean {
  const { list } = sweepOf(batch);
  return list?.length === 2 * batch.fields.length + 1 && Object.keys(list[0] ?? {}).length === 0;
}
