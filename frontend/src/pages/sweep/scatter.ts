/** What plotly draws of a sweep’s runs as points, those that differ in one field alone joined by lines. */

import { spansDecades } from "../../lib/steps";
import type { Strategy, StrategyId } from "../../api/types";
import { type Palette, chartLayout, lineTrace, pointTrace } from "../../plots/palettes";
import type { Markers, MarkerSymbol } from "../../plots/markers";
import type { LineTrace, PlotLayout, PointTrace } from "../../plots/plotly";
import { humanise } from "../../scenario/schema";
import { titleWithUnit } from "../../units/format";
import { type AxisOf, type Points, cell, type Columns } from "../../features/sweep/table";
import { fullName, type Metric } from "../../server/metrics";

interface Input {
  readonly points: readonly Points[];
  readonly strategies: readonly Strategy[];
  readonly markers: Markers;
  readonly x: AxisOf;
  readonly y: Metric;
  /** The table's rows to ring. */
  readonly ringed: readonly number[];
  /** What joins the ringed ones. */
  readonly front?: boolean;
  readonly lines: readonly Lines[];
  /** One field only is swept: the lines are curves, a strategy has one. */
  readonly curves: boolean;
  /** The rows whose points are hollow. */
  readonly isHollow: (row: number) => boolean;
  /** What a row says of itself, line by line. */
  readonly textOf: (row: number) => readonly string[];
  readonly palette: Palette;
  /** More points than these are for a canvas. */
  readonly most?: number;
}

interface ScatterFigure {
  /** Lines below the points. */
  readonly data: readonly (LineTrace | PointTrace)[];
  readonly layout: PlotLayout;
  readonly count: number;
  /** What is too much for plotly, which makes an element of each point: for a canvas over its axes. */
  readonly dots: readonly Dots[];
}

export interface Dots extends Points {
  readonly colour: string;
  readonly symbol: MarkerSymbol;
  readonly hollow: readonly boolean[];
}

/** More points than these are drawn on a canvas: as elements, 10 000 of them block the page for half a second. */
export const MANY = 2000;
const SIZE = 7;

/** Whether an axis of these values has decades. */
export function isSpreadByRatio(values: readonly (number | string)[]): boolean {
  const numbers = values.filter((value) => typeof value === "number");
  if (numbers.length === 0 || numbers.length < values.length) return false;
  let [low, high] = [Infinity, -Infinity];
  for (const value of numbers) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return spansDecades(low, high);
}

/** Decades have a line each, and are written as powers. */
const scaleOf = (points: readonly Points[]) =>
  isSpreadByRatio(points.flatMap(({ x }) => x))
    ? { type: "log", dtick: 1, exponentformat: "power" }
    : { exponentformat: "power" };

const named = (value: number | string) => (typeof value === "string" ? humanise(value) : value);

const strategyOf = (strategies: readonly Strategy[], id: string) => strategies.find((strategy) => strategy.id === id);
const symbolOf = (markers: Markers, id: string) => markers[id] ?? "circle";

function traces({ points, strategies, markers, isHollow, textOf, palette }: Input): readonly PointTrace[] {
  return points.map(({ strategy, rows, x: xs, y: ys }): PointTrace => {
    const { label = strategy, colour } = strategyOf(strategies, strategy) ?? {};
    const symbol = symbolOf(markers, strategy);
    const hollow = rows.map(isHollow);
    return {
      type: "scatter",
      mode: "markers",
      name: label,
      x: xs.map(named),
      y: ys,
      customdata: rows,
      marker: {
        color: colour,
        size: hollow.map((open) => (open ? SIZE + 3 : SIZE)),
        symbol: hollow.map((open) => (open ? `${symbol}-open` : symbol)),
        line: { width: hollow.map((open) => (open ? 1.6 : 0.75)), color: palette.text },
      },
      text: rows.map((row) => textOf(row).join("<br>")),
      hovertemplate: "%{text}<extra></extra>",
    };
  });
}

function joints({ lines, strategies, curves }: Input): readonly LineTrace[] {
  return lines.map(({ strategy, x, y }): LineTrace => {
    const { label = strategy, colour, dash } = strategyOf(strategies, strategy) ?? {};
    const place = { x: x.map((at) => (at === null ? null : named(at))), y };
    const line = { color: colour, dash: curves ? dash : "solid", width: curves ? 1.5 : 1 };
    return lineTrace(label, { ...place, ...line }, curves ? 1 : 0.6);
  });
}

/** Names in the order of x, in whichever order lines and points name them. */
function categories(points: readonly Points[]) {
  const names = [...new Set(points.flatMap(({ x }) => x.filter((place) => typeof place === "string")))].sort((a, b) =>
    a.localeCompare(b, "en", { numeric: true }),
  );
  return names.length === 0 ? {} : { categoryorder: "array", categoryarray: names.map(named) };
}

/** Nothing to see, and all that plotly needs to find the axes' ranges: the ends of both, or every name there is. */
function frame(points: readonly Points[]): PointTrace {
  const ends = (end: (one: number, other: number) => number) =>
    points.flatMap(({ y }) => (y.length > 0 ? [y.reduce((one, other) => end(one, other))] : []));
  // Rows are in ascending x: the ends are the first and the last.
  const places = points
    .flatMap(({ x }) => (typeof x[0] === "string" ? [...new Set(x)] : [x[0], x.at(-1)]))
    .filter((place) => place !== undefined);
  const [low, high] = [Math.min(...ends(Math.min)), Math.max(...ends(Math.max))];
  const x = [...places, ...places].map(named);
  const y = [...places.map(() => low), ...places.map(() => high)];
  return pointTrace("", { x, y, opacity: 0, size: SIZE });
}

/** Rings around rows, and for a front the staircase over them, which are its members. */
function rings({ points, ringed, front = false, palette }: Input): readonly (LineTrace | PointTrace)[] {
  const places = new Map(
    points.flatMap(({ rows, x, y }) => rows.map((row, index) => [row, [x[index] ?? 0, y[index] ?? 0]] as const)),
  );
  const members = ringed.map((row) => places.get(row)).filter((place) => place !== undefined);
  if (members.length === 0) return [];
  const place = { x: members.map(([x]) => named(x)), y: members.map(([, y]) => y) };
  const ring = { size: SIZE + (front ? 6 : 9), symbol: "circle-open", line: { width: 2, color: palette.text } };
  return [
    ...(front ? [lineTrace("Front", { ...place, color: palette.text, width: 1.5, shape: "hv" })] : []),
    pointTrace("Lowest", { ...place, color: palette.text, ...ring }),
  ];
}

export function scatterFigure(input: Input): ScatterFigure {
  const { points, strategies, markers, isHollow, x, y, palette, most = MANY } = input;
  const count = points.reduce((sum, { rows }) => sum + rows.length, 0);
  const many = count > most;
  return {
    count,
    dots: many
      ? points.map((each) => ({
          ...each,
          x: each.x.map(named),
          colour: strategyOf(strategies, each.strategy)?.colour ?? palette.text,
          symbol: symbolOf(markers, each.strategy),
          hollow: each.rows.map(isHollow),
        }))
      : [],
    data: [...(many ? [frame(points)] : [...joints(input), ...traces(input)]), ...rings(input)],
    layout: chartLayout(palette, {
      margin: { l: 56, r: 16, t: 8, b: 52 },
      // Somebody's zoom stays while rows arrive.
      uirevision: `${x.name} ${y.key}`,
      xaxis: { title: { text: titleWithUnit(x.title, x.unit) }, ...scaleOf(points), ...categories(points) },
      yaxis: {
        title: { text: titleWithUnit(fullName(y), y.unit) },
        zeroline: true,
        zerolinecolor: palette.zero,
        rangemode: "tozero",
      },
    }),
  };
}

/** A strategy's lines one after the other, with a gap (`null`) between them. */
interface Lines {
  readonly strategy: StrategyId;
  readonly x: readonly (number | string | null)[];
  readonly y: readonly (number | null)[];
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
  if (groups.reduce((sum, { length }) => sum + length, 0) > MOST) return [];
  return points.map(({ strategy, x, y }, line) => ({
    strategy,
    x: (groups[line] ?? []).flatMap((group) => [...group.map((index) => x[index] ?? null), null]),
    y: (groups[line] ?? []).flatMap((group) => [...group.map((index) => y[index] ?? null), null]),
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
