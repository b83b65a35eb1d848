/** A batch's rows as columns: which are shown, in which order, and which is best. */

import { queryOptions } from "@tanstack/react-query";
import type { BatchTable, StrategyId, Batch, JsonValue } from "../../api/types";
import { inOrder } from "../../lib/order";
import { humanise } from "../../scenario/schema";
import { formatExact, formatResult } from "../../units/format";
import { ask } from "../../api/http";
import { isFinal } from "../../jobs/useJob";
import { api } from "../../api/client";
import { useRunInLab, type RunInLab } from "../../ui/openInLab";
import { withFields } from "../../scenario/fields";

export type Cell = BatchTable["columns"][string][number] | undefined;
export type Columns = BatchTable["columns"];

export const cell = (columns: Columns, name: string, row: number): Cell => columns[name]?.[row];

/** A cell of a column of texts; empty where there is none. */
export function textCell(columns: Columns, name: string, row: number): string {
  const value = cell(columns, name, row);
  return typeof value === "string" ? value : "";
}

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

/** The fields of a sweep as axes. */
export interface AxisOf {
  readonly name: string;
  readonly title: string;
  readonly unit: string;
}

/** The fields that are swept by themselves, each named with those that take its value. */
export function axesOf(fields: Batch["fields"]): readonly AxisOf[] {
  return fields
    .filter(({ linked_to: leader }) => leader === null)
    .map(({ name, title, unit }) => ({
      name,
      unit,
      title: [title, ...fields.filter((each) => each.linked_to === name).map((each) => each.title.toLowerCase())].join(
        " = ",
      ),
    }));
}

/** What a sweep is called by the fields it changes. */
export const titleOf = (fields: Batch["fields"]) =>
  axesOf(fields)
    .map(({ title }) => title)
    .join(" × ") || "The scenario alone";

/** A swept value: with all the digits that tell it from its neighbours. */
export function showCell(value: Cell, unit = "1"): string {
  if (typeof value === "number") return formatExact(Number(value.toPrecision(6)), unit);
  if (typeof value === "string") return humanise(value);
  if (Array.isArray(value)) return value.map((each) => formatExact(Number(each), "1")).join(", ");
  return "off";
}

export function showFigure(value: Cell, scale: number): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  return typeof value === "number" ? formatResult(value * scale, 4) : "–";
}

/** The column of what becomes of each run's requirements, which the page adds. */
export const REQUIRED = "requirements";

/** Rows are asked for again while a batch runs, the less often the more there are, and soon until there are some [ms]. */
function refreshEvery({ total, done }: Batch, table?: BatchTable): number {
  if (table !== undefined && done > 0 && table.columns.status?.includes("ok") !== true) return 1_000;
  return total <= 1000 || done <= 1000 ? 3_000 : 10_000;
}

/** A batch's rows, column by column. */
export const tableQuery = (batch: Batch, figures: readonly string[]) =>
  queryOptions({
    // A table of the final state is another one than those before it.
    queryKey: ["batch table", batch.id, isFinal(batch), figures],
    queryFn: ({ signal }) =>
      ask("get", "/batches/{id}/table", { path: { id: batch.id }, query: { figures: figures.join(",") } }, signal),
    enabled: figures.length > 0,
    staleTime: Infinity,
    gcTime: 5 * 60_000,
    refetchInterval: (query) => !isFinal(batch) && refreshEvery(batch, query.state.data),
  });

/** How a batch's runs keep what is required of them. */
export const batchRequirementsQuery = (batch: Batch) =>
  queryOptions({
    queryKey: ["batch requirements", batch.id, isFinal(batch)],
    queryFn: ({ signal }) => ask("get", "/batches/{id}/requirements", { path: { id: batch.id } }, signal),
    enabled: batch.requirements.length > 0,
    staleTime: Infinity,
    refetchInterval: !isFinal(batch) && refreshEvery(batch),
  });

interface RunAtValues {
  readonly run: number;
  /** The swept fields' values. */
  readonly at: Readonly<Record<string, JsonValue>>;
}

export type Opening = RunInLab<RunAtValues>;

export const useOpenRun = ({ scenario, strategies }: Batch): Opening =>
  useRunInLab(({ at }) => api.createRun(withFields(scenario, at), strategies));
