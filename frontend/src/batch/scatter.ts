/** What plotly draws of a sweep. */

import type { Batch, Strategy } from "../api/types";
import type { Palette } from "../plots/figure";
import type { PlotLayout, PointTrace } from "../plots/plotly";
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
}

/** Apart without their colour too. */
const SYMBOLS = ["circle", "diamond", "square", "triangle-up", "cross", "x"] as const;
const MANY = 2000;
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

const axisTitle = (label: string, unit: string) => (prettyUnit(unit) === "" ? label : `${label} [${prettyUnit(unit)}]`);

export function scatterFigure({ points, strategies, x, y, best, joined, palette }: Input): ScatterFigure {
  const count = points.reduce((sum, { rows }) => sum + rows.length, 0);
  const size = count > MANY ? 4 : 7;
  const data = points.map(({ strategy, rows, x: xs, y: ys }): PointTrace => {
    const look = strategies.find(({ id }) => id === strategy);
    const symbol = SYMBOLS[strategies.findIndex(({ id }) => id === strategy) % SYMBOLS.length];
    return {
      type: "scatter",
      mode: joined ? "lines+markers" : "markers",
      name: look?.label ?? strategy,
      x: xs,
      y: ys,
      customdata: rows,
      marker: { color: look?.colour, size, symbol, opacity: count > MANY ? 0.6 : 0.85 },
      ...(joined ? { line: { color: look?.colour, dash: look?.dash, width: 1.5 } } : {}),
      hovertemplate: `%{x} ${prettyUnit(x.unit)}, %{y:.4~g} ${prettyUnit(y.unit)}<extra>${look?.label ?? strategy}</extra>`,
    };
  });
  const ring = points.flatMap(({ rows, x: xs, y: ys }): PointTrace[] => {
    const index = best === null ? -1 : rows.indexOf(best);
    const [atX, atY] = [xs[index], ys[index]];
    if (best === null || atX === undefined || atY === undefined) return [];
    const marker = { color: palette.text, size: size + 9, symbol: "circle-open", line: { width: 2, color: palette.text } };
    return [{ type: "scatter", mode: "markers", name: "Lowest", x: [atX], y: [atY], customdata: [best], marker, hoverinfo: "skip" }];
  });
  const axis = { color: palette.text, gridcolor: palette.grid, zerolinecolor: palette.zero, automargin: true };
  return {
    count,
    data: [...data, ...ring],
    layout: {
      font: { family: "inherit", color: palette.text, size: 12 },
      margin: { l: 56, r: 16, t: 8, b: 44 },
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      showlegend: false,
      hovermode: "closest",
      // Somebody's zoom stays while rows arrive.
      uirevision: `${x.name} ${y.key}`,
      xaxis: { ...axis, title: { text: axisTitle(x.title, x.unit) }, type: isLogarithmic(points) ? "log" : "-" },
      yaxis: { ...axis, title: { text: axisTitle(fullName(y), y.unit) }, rangemode: "tozero" },
      shapes: [],
    },
  };
}
