/** A metric over two swept fields: one strategy's, or its change against another's in percent. */

import type { StrategyId } from "../../api/types";
import { changeAgainst } from "../../features/tables/change";
import { cell, REQUIRED, type Columns } from "../../features/sweep/table";

export type AxisValue = number | string;

/** One cell for each pair of values, `null` where there is no run or it has no value. */
export interface MapGrid {
  readonly xs: readonly AxisValue[];
  readonly ys: readonly AxisValue[];
  readonly values: readonly (readonly (number | null)[])[];
  /** The strategy's row in the table. */
  readonly rows: readonly (readonly (number | null)[])[];
}

/** Events beyond the linear model. */
const BEYOND_LINEAR = ["events.airborne_ms", "events.stop_contact_ms"];

/** Where a tyre was in the air or a bump stop was hit, cell by cell. */
export const hatched = ({ rows }: MapGrid, columns: Columns): readonly (readonly boolean[])[] =>
  rows.map((line) =>
    line.map((row) => row !== null && BEYOND_LINEAR.some((event) => Number(cell(columns, event, row) ?? 0) >= 1)),
  );

/** Where the run fails what is required of it, cell by cell. */
export const failing = ({ rows }: MapGrid, columns: Columns): readonly (readonly boolean[])[] =>
  rows.map((line) => line.map((row) => row !== null && cell(columns, REQUIRED, row) === "fail"));

/** The first run of these cells; `null` where there is none. */
export function firstOf({ rows }: MapGrid, cells: readonly (readonly boolean[])[]): number | null {
  const marked = rows.flatMap((line, i) =>
    line.filter((row, j): row is number => row !== null && cells[i]?.[j] === true),
  );
  return marked.length > 0 ? Math.min(...marked) : null;
}

/** Where a change [%] is within the luck of the roads, cell by cell. */
export const unsettled = ({ values }: MapGrid, noise: number): readonly (readonly boolean[])[] =>
  values.map((line) => line.map((value) => value !== null && Math.abs(value) < noise));

/** Of each cell that has no value yet the nearest one's, counted in cells; `null` in those that have one or failed. */
export function coarse({ values, rows }: MapGrid, columns: Columns): readonly (readonly (number | null)[])[] {
  const nearest = values.map((line) => [...line]);
  let reached = values.flatMap((line, i) => line.flatMap((value, j) => (value === null ? [] : [[i, j] as const])));
  while (reached.length > 0)
    reached = reached.flatMap(([i, j]) =>
      [[i - 1, j] as const, [i + 1, j] as const, [i, j - 1] as const, [i, j + 1] as const].filter(([y, x]) => {
        const line = nearest[y];
        if (line?.[x] !== null) return false;
        line[x] = nearest[i]?.[j] ?? null;
        return true;
      }),
    );
  const isComing = (row: number | null | undefined) =>
    typeof row === "number" && cell(columns, "status", row) !== "failed";
  return values.map((line, i) =>
    line.map((value, j) => (value === null && isComing(rows[i]?.[j]) ? (nearest[i]?.[j] ?? null) : null)),
  );
}

interface Question {
  readonly x: string;
  readonly y: string;
  readonly metric: string;
  readonly scale: number;
  readonly strategy: StrategyId;
  readonly against: StrategyId | null;
}

/** A map of points that lie apart would be mostly gaps. */
const LEAST_FILLED = 0.2;

const isAxisValue = (value: unknown): value is AxisValue => typeof value === "number" || typeof value === "string";

const sorted = (values: Iterable<AxisValue>): readonly AxisValue[] =>
  [...new Set(values)].sort((a, b) =>
    typeof a === "number" && typeof b === "number"
      ? a - b
      : String(a).localeCompare(String(b), "en", { numeric: true }),
  );

const cellKey = (x: unknown, y: unknown) => JSON.stringify([x, y]);

function rowsByCell(columns: Columns, strategy: StrategyId, x: string, y: string): ReadonlyMap<string, number> {
  const rows = (columns.strategy ?? []).flatMap((name, row) => (name === strategy ? [row] : []));
  return new Map(rows.map((row) => [cellKey(cell(columns, x, row), cell(columns, y, row)), row]));
}

/** `null` where the points make no grid. */
export function mapGrid(columns: Columns, { x, y, metric, scale, strategy, against }: Question): MapGrid | null {
  const own = rowsByCell(columns, strategy, x, y);
  const other = against === null ? null : rowsByCell(columns, against, x, y);
  const at = (name: string) => sorted([...own.values()].map((row) => cell(columns, name, row)).filter(isAxisValue));
  const [xs, ys] = [at(x), at(y)];
  if (xs.length < 2 || ys.length < 2 || own.size < LEAST_FILLED * xs.length * ys.length) return null;
  const valueAt = (row: number | undefined) => {
    const value = row === undefined ? null : cell(columns, metric, row);
    return typeof value === "number" ? value : null;
  };
  const rows = ys.map((atY) => xs.map((atX) => own.get(cellKey(atX, atY)) ?? null));
  const values = rows.map((line, i) =>
    line.map((row, j) => {
      const value = valueAt(row ?? undefined);
      if (value === null || other === null) return value === null ? null : value * scale;
      return changeAgainst(value, valueAt(other.get(cellKey(xs[j], ys[i])))).percent;
    }),
  );
  return { xs, ys, values, rows };
}

export interface Share {
  /** Points at or below the threshold. */
  readonly below: number;
  /** Points with a value. */
  readonly computed: number;
  readonly gaps: number;
}

export function shareBelow({ values }: MapGrid, threshold: number): Share {
  const all = values.flat();
  const computed = all.filter((value) => value !== null);
  return {
    below: computed.filter((value) => value <= threshold).length,
    computed: computed.length,
    gaps: all.length - computed.length,
  };
}
