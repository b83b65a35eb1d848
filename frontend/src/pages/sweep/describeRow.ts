/** A run of a sweep in words: where it is, its values, and its caveats. */

import type { Batch, Catalogue, Strategy } from "../../api/types";
import { CAVEAT_EVENTS, caveatsOf, type Caveat } from "../../features/tables/caveats";
import { formatResult, isNothing, prettyUnit } from "../../units/format";
import { fullName, type Metric } from "../../server/metrics";
import { cell, REQUIRED, showCell, type Columns } from "../../features/sweep/table";

const columnOf = (event: string) => `events.${event}`;

/** Asked for with every table, whatever is shown. */
export const CAVEAT_COLUMNS = CAVEAT_EVENTS.map(columnOf);

export function caveatsOfRow(columns: Columns, row: number, catalogue: Catalogue): readonly Caveat[] {
  const events = CAVEAT_EVENTS.map((event) => {
    const value = cell(columns, columnOf(event), row);
    return [event, typeof value === "number" || typeof value === "boolean" ? value : null] as const;
  });
  return caveatsOf(Object.fromEntries(events), catalogue);
}

export function isAirborne(columns: Columns, row: number): boolean {
  const value = cell(columns, columnOf("airborne_ms"), row);
  return typeof value === "number" && !isNothing(value);
}

/** `Height 0.05 m`, for every swept field. */
export const fieldTexts = (columns: Columns, row: number, fields: Batch["fields"]): readonly string[] =>
  fields.map(({ name, title, unit }) => `${title} ${showCell(cell(columns, name, row), unit)}`);

interface Context {
  readonly columns: Columns;
  readonly fields: Batch["fields"];
  readonly strategies: readonly Strategy[];
  readonly y: Metric;
  readonly catalogue: Catalogue;
}

/** The lines of what stands by a point under the pointer. */
export function describeRow(row: number, { columns, fields, strategies, y, catalogue }: Context): readonly string[] {
  const value = formatResult(Number(cell(columns, y.key, row)) * y.scale, 4);
  return [
    strategies.find(({ id }) => id === cell(columns, "strategy", row))?.label ?? "",
    ...fieldTexts(columns, row, fields),
    `${fullName(y)}: ${value} ${prettyUnit(y.unit)}`.trim(),
    ...(cell(columns, REQUIRED, row) === "fail" ? ["✕ A requirement fails"] : []),
    ...caveatsOfRow(columns, row, catalogue).map(({ text }) => `⚠ ${text}`),
  ];
}
