/** The spread of a metric under each strategy, as plotly draws it on the page and in a file; and each field alone. */

import type { BatchSummary, Strategy, Batch, StrategyId } from "../../api/types";
import { fullName, type Metric } from "../../server/metrics";
import { chartLayout, lineTrace, type Palette } from "../../plots/palettes";
import type { ChartOnPaper } from "../../plots/paperChart";
import type { PointTrace } from "../../plots/plotly";
import { titleWithUnit } from "../../units/format";
import { quantile } from "./study";
import { type Cell, cell, type Columns } from "../../features/sweep/table";

type Value = number | null | undefined;
type Ends = readonly [Value, Value];

const bars = (name: string, ends: readonly Ends[], color: string, width: number) =>
  lineTrace(name, {
    x: ends.flatMap(([low, high]) => [low ?? null, high ?? null, null]),
    y: ends.flatMap((_, index) => [index, index, null]),
    color,
    width,
  });

function points(name: string, values: readonly Value[], symbol: string, color: string): PointTrace {
  const there = values.flatMap((value, index) => (typeof value === "number" ? [{ value, index }] : []));
  return {
    type: "scatter",
    mode: "markers",
    name,
    customdata: [],
    x: there.map(({ value }) => value),
    y: there.map(({ index }) => index),
    marker: { color, symbol, size: 9, line: { color, width: 2 } },
    hovertemplate: `${name}: %{x:.3~g}<extra></extra>`,
  };
}

/** The first name stands above. */
const layoutOf = (palette: Palette, title: string, names: readonly string[], rest: object) =>
  chartLayout(palette, {
    margin: { l: 8, r: 12, t: 8, b: 8 },
    xaxis: { title: { text: title.replace(", ", ",<br>") }, ...rest },
    yaxis: {
      tickvals: names.map((_, index) => index),
      ticktext: names,
      range: [names.length - 0.5, -0.5],
      showgrid: false,
    },
  });

const PERCENTS = [5, 25, 50, 75, 95];

export function spreadChart(
  summary: BatchSummary,
  strategies: readonly Strategy[],
  figure: Metric,
  palette: Palette,
): ChartOnPaper {
  const rows = strategies.flatMap(({ id, label }) => {
    const results = summary.strategies[id]?.figures[figure.key];
    const scaled = (value: Value) => (typeof value === "number" ? value * figure.scale : null);
    if (!results) return [];
    const quantiles = PERCENTS.map((percent) => scaled(quantile(summary, results, percent)));
    return [{ label, nominal: scaled(results.nominal), worst: scaled(results.highest?.value), quantiles }];
  });
  const names = rows.map(({ label }) => label);
  const title = titleWithUnit(fullName(figure), figure.unit);
  const ends = (from: number, to: number) => rows.map(({ quantiles }): Ends => [quantiles[from], quantiles[to]]);
  const marks = (name: string, symbol: string, valueOf: (row: (typeof rows)[number]) => Value) =>
    points(name, rows.map(valueOf), symbol, palette.text);
  const data = [
    bars("5 to 95 %", ends(0, 4), "#9db8d9", 5),
    bars("25 to 75 %", ends(1, 3), "#3b6fb5", 11),
    marks("Median", "line-ns", ({ quantiles }) => quantiles[2]),
    marks("Nominal", "diamond-open", ({ nominal }) => nominal),
    marks("Worst case", "circle-open", ({ worst }) => worst),
  ];
  return {
    figure: { data, layout: layoutOf(palette, title, names, { rangemode: "tozero" }) },
    table: [
      [
        "Strategy",
        ...["Nominal", ...PERCENTS.map((percent) => `${percent} %`), "Worst case"].map((head) => `${head}: ${title}`),
      ],
      ...rows.map(({ label, nominal, quantiles, worst }) => [label, nominal, ...quantiles, worst]),
    ],
  };
}

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
  const { list } = batch.sweep;
  return list?.length === 2 * batch.fields.length + 1 && Object.keys(list[0] ?? {}).length === 0;
}
