/** A metric over two swept fields: one strategy's, or its change against another's in percent; over several roads means. */

import { type StrategyId } from "../../api/types";
import { changeAgainst } from "../../features/tables/change";
import { cell, REQUIRED, rowsOf, type Columns } from "../../features/sweep/table";
import { SEED } from "../../scenario/fields";

export type AxisValue = number | string;

/** One cell for each pair of values, `null` where there is no run or it has no value. */
export interface MapGrid {
  readonly xs: readonly AxisValue[];
  readonly ys: readonly AxisValue[];
  readonly values: readonly (readonly (number | null)[])[];
  /** Half the width of a change's interval over the roads; 0 on one. */
  readonly halves: readonly (readonly number[])[];
  /** Whether a change may be random: its interval over the roads contains zero, or it is not beyond the random variation of one road. */
  readonly unsettled: Marked;
  /** The strategy's rows in the table, one for each road. */
  readonly rows: readonly (readonly (readonly number[])[])[];
}

export type Marked = readonly (readonly boolean[])[];

/** Events beyond the linear model. */
const STOPS = "events.stop_contact_ms";
const BEYOND_LINEAR = ["events.airborne_ms", STOPS];

/** Runs stored before bump stops were recorded say nothing of them. */
export const lacksStops = (columns: Columns): boolean =>
  rowsOf(columns, (row) => cell(columns, "status", row) === "ok" && typeof cell(columns, STOPS, row) !== "number")
    .length > 0;

/** Where that is so in one of the runs, cell by cell. */
const marked = ({ rows }: MapGrid, isSo: (row: number) => boolean): Marked =>
  rows.map((line) => line.map((runs) => runs.some(isSo)));

/** Where a tyre was in the air or a bump stop was hit. */
export const hatched = (grid: MapGrid, columns: Columns): Marked =>
  marked(grid, (row) => BEYOND_LINEAR.some((event) => Number(cell(columns, event, row) ?? 0) >= 1));

const fails = (columns: Columns) => (row: number) => cell(columns, REQUIRED, row) === "fail";

/** Where a run fails what is required of it. */
export const failing = (grid: MapGrid, columns: Columns): Marked => marked(grid, fails(columns));

/** The first run that fails what is required of it; `null` where there is none. */
export function firstFailure({ rows }: MapGrid, columns: Columns): number | null {
  const failed = rows.flat(2).filter(fails(columns));
  return failed.length > 0 ? Math.min(...failed) : null;
}

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
  const isComing = (runs: readonly number[] = []) => runs.some((row) => cell(columns, "status", row) !== "failed");
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
  /** Smaller changes [%] on one road may be random. */
  readonly oneRoadNoise: number;
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

function rowsByCell(columns: Columns, strategy: StrategyId, x: string, y: string): ReadonlyMap<string, number[]> {
  const rows = (columns.strategy ?? []).flatMap((name, row) => (name === strategy ? [row] : []));
  const cells = new Map<string, number[]>();
  for (const row of rows) {
    const key = cellKey(cell(columns, x, row), cell(columns, y, row));
    cells.set(key, [...(cells.get(key) ?? []), row]);
  }
  return cells;
}

/** `null` where the points make no grid. */
export function mapGrid(columns: Columns, question: Question): MapGrid | null {
  const { x, y, metric, scale, strategy, against, oneRoadNoise } = question;
  const own = rowsByCell(columns, strategy, x, y);
  const other = against === null ? null : rowsByCell(columns, against, x, y);
  const at = (name: string) =>
    sorted([...own.values()].map(([row = -1]) => cell(columns, name, row)).filter(isAxisValue));
  const [xs, ys] = [at(x), at(y)];
  if (xs.length < 2 || ys.length < 2 || own.size < LEAST_FILLED * xs.length * ys.length) return null;
  const valueAt = (row: number | undefined) => {
    const value = row === undefined ? null : cell(columns, metric, row);
    return typeof value === "number" ? value : null;
  };
  const cells = ys.map((atY) =>
    xs.map((atX) => {
      const key = cellKey(atX, atY);
      const rows = own.get(key) ?? [];
      if (other === null) {
        const values = rows.map(valueAt).filter((value) => value !== null);
        return { rows, value: values.length > 0 ? mean(values) * scale : null, half: 0, isUnsettled: false };
      }
      const bases = other.get(key) ?? [];
      const onSameRoad = (row: number) => bases.find((base) => cell(columns, SEED, base) === cell(columns, SEED, row));
      const pairs = rows.flatMap((row) => {
        const [value, base] = [valueAt(row), valueAt(onSameRoad(row))];
        return value === null || base === null ? [] : [[value, base] as const];
      });
      return { rows, ...changeOf(pairs, oneRoadNoise) };
    }),
  );
  return {
    xs,
    ys,
    values: cells.map((line) => line.map(({ value }) => value)),
    halves: cells.map((line) => line.map(({ half }) => half)),
    unsettled: cells.map((line) => line.map(({ isUnsettled }) => isUnsettled)),
    rows: cells.map((line) => line.map(({ rows }) => rows)),
  };
}

/** Of a value and what it is compared with on each road: over several the change of the means. */
function changeOf(pairs: readonly (readonly [number, number])[], oneRoadNoise: number) {
  const over = pairedChangeOf(
    pairs.map(([value]) => value),
    pairs.map(([, base]) => base),
  );
  const value = over?.percent ?? changeAgainst(pairs[0]?.[0], pairs[0]?.[1]).percent;
  return {
    value,
    half: over?.half ?? 0,
    isUnsettled: value !== null && Math.abs(value) < (over ? over.half : oneRoadNoise),
  };
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

/** How sure a mean over roads is: 95 % intervals, as sim_core/comparison/intervals.py has them. */
const NORMAL = 1.959963984540054; // 97.5 % of the normal distribution lie below

/** Below which 97.5 % of Student's t lie; from three degrees of freedom on by Abramowitz and Stegun, 26.7.5, to 0.2 %. */
export function studentQuantile(freedom: number): number {
  if (freedom === 1) return Math.tan(0.475 * Math.PI);
  if (freedom === 2) return 0.95 / Math.sqrt(2 * 0.975 * 0.025);
  const z = NORMAL;
  return [
    (z ** 3 + z) / 4,
    (5 * z ** 5 + 16 * z ** 3 + 3 * z) / 96,
    (3 * z ** 7 + 19 * z ** 5 + 17 * z ** 3 - 15 * z) / 384,
    (79 * z ** 9 + 776 * z ** 7 + 1482 * z ** 5 - 1920 * z ** 3 - 945 * z) / 92_160,
  ].reduce((sum, term, order) => sum + term / freedom ** (order + 1), z);
}

const mean = (values: readonly number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

/**
 * Change of the mean of `values` against that of `bases` [%], of the same roads in the same order, and half the width of
 * its interval, by linearisation (Cochran 1977, Sampling Techniques, 6.4). `null` without two roads or against zero.
 */
export function pairedChangeOf(
  values: readonly number[],
  bases: readonly number[],
): { readonly percent: number; readonly half: number } | null {
  const [base, count] = [mean(bases), values.length];
  if (count < 2 || base === 0) return null;
  const ratio = mean(values) / base;
  const squares = values.map((value, road) => ((value - ratio * (bases[road] ?? 0)) / base) ** 2);
  const half = studentQuantile(count - 1) * Math.sqrt(mean(squares) / (count - 1));
  return { percent: 100 * (ratio - 1), half: 100 * half };
}
