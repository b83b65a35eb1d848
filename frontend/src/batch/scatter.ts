/** What plotly draws of a sweep. */

import type { Batch, Strategy } from "../api/types";
import type { Palette } from "../plots/figure";
import type { PlotLayout, PointTrace } from "../plots/plotly";
import { humanise } from "../editor/schema";
import { prettyUnit } from "../units/format";
import { fullName, type Figure } from "./figures";
import type { Points } from "./table";

interface Input {
  readonly points: readonly Points[];
  readonly strategies: readonly Strategy[];
  readonly x: Batch["fields"][number];
  readonly y: Figure;
  /** The table's row to ring. */
  readonly best: number | null;
  /** One field only is swept: the points are a curve. */
  readonly joined: boolean;
  readonly palette: Palette;
}

export interface ScatterFigure {
  readonly data: readonly PointTrace[];
  readonly layout: PlotLayout;
  readonly count: number;
  /** What is too much for plotly, which makes an element of each point: for a canvas over its axes. */
  readonly dots: readonly Dots[];
}

export interface Dots extends Points {
  readonly label: string;
  readonly colour: string;
  readonly symbol: (typeof SYMBOLS)[number];
}

/** Apart without their colour too. */
const SYMBOLS = ["circle", "diamond", "square", "triangle-up", "cross", "x"] as const;
/** More points than these are drawn on a canvas: as elements, 10 000 of them block the page for half a second. */
export const MANY = 2000;
const SIZE = 7;
const DECADES_RATIO = 100;

function isLogarithmic(points: readonly Points[]): boolean {
  const values = points.flatMap(({ x }) => x);
  const numbers = values.filter((value) => typeof value === "number");
  if (numbers.length === 0 || numbers.length < values.length) return false;
  let [low, high] = [Infinity, -Infinity];
  for (const value of numbers) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return low > 0 && high / low >= DECADES_RATIO;
}

/** Decades have a line each, and are written as powers. */
const scaleOf = (points: readonly Points[]) => (isLogarithmic(points) ? { type: "log", dtick: 1, exponentformat: "power" } : { exponentformat: "power" });

const named = (value: number | string) => (typeof value === "string" ? humanise(value) : value);

const axisTitle = (label: string, unit: string) => (prettyUnit(unit) === "" ? label : `${label} [${prettyUnit(unit)}]`);

const look = (strategies: readonly Strategy[], id: string) => strategies.find((strategy) => strategy.id === id);
const symbolOf = (strategies: readonly Strategy[], id: string) =>
  SYMBOLS[Math.max(0, strategies.findIndex((strategy) => strategy.id === id)) % SYMBOLS.length] ?? SYMBOLS[0];

function traces({ points, strategies, x, y, joined, palette }: Input): readonly PointTrace[] {
  return points.map(({ strategy, rows, x: xs, y: ys }): PointTrace => {
    const { label = strategy, colour, dash } = look(strategies, strategy) ?? {};
    return {
      type: "scatter",
      mode: joined ? "lines+markers" : "markers",
      name: label,
      x: xs.map(named),
      y: ys,
      customdata: rows,
      marker: { color: colour, size: SIZE, symbol: symbolOf(strategies, strategy), line: { width: 0.75, color: palette.text } },
      ...(joined ? { line: { color: colour, dash, width: 1.5 } } : {}),
      hovertemplate: `%{x} ${prettyUnit(x.unit)}, %{y:.4~g} ${prettyUnit(y.unit)}<extra>${label}</extra>`,
    };
  });
}

/** Nothing to see, and all that plotly needs to find the axes' ranges: the ends of both, or every name there is. */
function frame(points: readonly Points[]): readonly PointTrace[] {
  const lows = points.flatMap(({ y }) => (y.length > 0 ? [y.reduce((low, value) => Math.min(low, value))] : []));
  const highs = points.flatMap(({ y }) => (y.length > 0 ? [y.reduce((high, value) => Math.max(high, value))] : []));
  // Rows are in ascending x: the ends are the first and the last.
  const places = points.flatMap(({ x }) => (typeof x[0] === "string" ? [...new Set(x)] : [x[0], x.at(-1)])).filter((place) => place !== undefined);
  const [low, high] = [Math.min(...lows), Math.max(...highs)];
  const x = [...places, ...places].map(named);
  const y = [...places.map(() => low), ...places.map(() => high)];
  return [{ type: "scatter", mode: "markers", name: "", x, y, customdata: [], marker: { opacity: 0, size: SIZE }, hoverinfo: "skip" }];
}

export function scatterFigure(input: Input): ScatterFigure {
  const { points, strategies, x, y, best, palette } = input;
  const count = points.reduce((sum, { rows }) => sum + rows.length, 0);
  const many = count > MANY;
  const data = many ? frame(points) : traces(input);
  const ring = points.flatMap(({ rows, x: xs, y: ys }): PointTrace[] => {
    const index = best === null ? -1 : rows.indexOf(best);
    const [atX, atY] = [xs[index], ys[index]];
    if (best === null || atX === undefined || atY === undefined) return [];
    const marker = { color: palette.text, size: SIZE + 9, symbol: "circle-open", line: { width: 2, color: palette.text } };
    return [{ type: "scatter", mode: "markers", name: "Lowest", x: [named(atX)], y: [atY], customdata: [best], marker, hoverinfo: "skip" }];
  });
  const axis = { color: palette.text, gridcolor: palette.grid, zerolinecolor: palette.zero, automargin: true };
  return {
    count,
    dots: many
      ? points.map((each) => ({
          ...each,
          x: each.x.map(named),
          label: look(strategies, each.strategy)?.label ?? each.strategy,
          colour: look(strategies, each.strategy)?.colour ?? palette.text,
          symbol: symbolOf(strategies, each.strategy),
        }))
      : [],
    data: [...data, ...ring],
    layout: {
      font: { family: "inherit", color: palette.text, size: 12 },
      margin: { l: 56, r: 16, t: 8, b: 52 },
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      showlegend: false,
      hovermode: "closest",
      // Somebody's zoom stays while rows arrive.
      uirevision: `${x.name} ${y.key}`,
      xaxis: { ...axis, title: { text: axisTitle(x.title, x.unit) }, ...scaleOf(points) },
      yaxis: { ...axis, title: { text: axisTitle(fullName(y), y.unit) }, rangemode: "tozero" },
      shapes: [],
    },
  };
}
