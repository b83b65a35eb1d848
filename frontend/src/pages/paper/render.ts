/** A figure the server has made, in this page's colours and with its legend outside. Pure. */

import type { JsonObject, JsonValue, MadeFigure } from "../../api/types";
import type { ChartFigure } from "../../plots/Chart";
import type { Palette } from "../../plots/palettes";

export type Scheme = "light" | "dark";

/** As --surface in global.css: plotly takes no variables. */
const SURFACES: Readonly<Record<Scheme, string>> = { light: "#ffffff", dark: "#1a1b1e" };
/** The name of the stage's shape. */
const BUMP = "Bump";
const MARGIN = { l: 62, r: 14, t: 6, b: 44 } as const;

function isObject(value: JsonValue | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

const text = (value: JsonValue | undefined, otherwise: string) => (typeof value === "string" ? value : otherwise);

export interface Look {
  readonly palette: Palette;
  readonly scheme: Scheme;
  /** Of a time history only what happens on the bump. */
  readonly bumpOnly: boolean;
}

export function drawn(figure: MadeFigure, { palette, scheme, bumpOnly }: Look): ChartFigure {
  const { data, layout } = figure;
  const axis = { color: palette.text, gridcolor: palette.grid, zerolinecolor: palette.zero, automargin: true };
  const bump = bumpOnly ? bumpRange(figure) : null;
  return {
    data: [...data],
    layout: {
      font: { family: "inherit", color: palette.text, size: 12 },
      margin: MARGIN,
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      showlegend: false,
      hovermode: "x unified",
      hoverlabel: {
        bgcolor: SURFACES[scheme],
        bordercolor: palette.zero,
        font: { color: palette.text, size: 12 },
        namelength: -1,
      },
      dragmode: "zoom",
      xaxis: { ...layout.xaxis, ...axis, ...titled(layout.xaxis), ...(bump && { range: bump }) },
      yaxis: { ...layout.yaxis, ...axis, ...titled(layout.yaxis) },
      shapes: shapesOf(figure),
    },
  };
}

const titled = (axis: JsonObject | undefined) =>
  isObject(axis?.title) ? { title: { ...axis.title, standoff: 6, font: { size: 12 } } } : {};

function shapesOf({ layout: { shapes } }: MadeFigure): readonly JsonObject[] {
  return Array.isArray(shapes) ? (shapes as readonly JsonObject[]) : [];
}

/** Shown before the bump and after it [m]: the previewed road, and how the car settles. */
const [BEFORE, AFTER] = [8, 15];

/** From a little before the bump's stage to a little after; `null` where the figure has none. */
export function bumpRange(figure: MadeFigure): readonly [number, number] | null {
  const bump = shapesOf(figure).find(
    ({ name, x0, x1 }) => name === BUMP && typeof x0 === "number" && typeof x1 === "number",
  );
  return bump ? [Number(bump.x0) - BEFORE, Number(bump.x1) + AFTER] : null;
}

export interface LegendEntry {
  readonly name: string;
  readonly colour: string;
  readonly dash: string;
  /** Where it is an area, not a line. */
  readonly fill: string | null;
}

/** Curves first, then what stands behind them: stages, bands, reference lines. */
export const legendOf = (figure: MadeFigure): readonly LegendEntry[] => [
  ...figure.data.map((trace) => entryOf(trace.name, trace, typeof trace.fill === "string" && trace.fill !== "none")),
  ...shapesOf(figure).flatMap((shape) =>
    typeof shape.name === "string" ? [entryOf(shape.name, shape, shape.type === "rect")] : [],
  ),
];

function entryOf(name: string, { line, fillcolor }: JsonObject, isArea: boolean): LegendEntry {
  const { color, dash } = isObject(line) ? line : {};
  return {
    name,
    colour: text(color, "currentColor"),
    dash: text(dash, "solid"),
    fill: isArea ? text(fillcolor, "currentColor") : null,
  };
}

/** With stages, bands and reference lines in its own legend: on paper there is no other one. */
export const withNamedShapes = ({ data, layout }: ChartFigure): ChartFigure => ({
  data,
  layout: {
    ...layout,
    shapes: layout.shapes.map((shape) => ({ ...shape, showlegend: typeof shape.name === "string" })),
  },
});
