/** A chart as a paper or a slide takes it, and its numbers as a table. */

import { decodeArray } from "../api/decode";
import type { ChartFigure } from "./Chart";
import { cell, comment, printed, type PaperFigure, type PaperSize } from "./saved";
import { POINT, sheet } from "./paperFigure";
import type { AnyTrace, GridTrace, PlotElement, PlotLayout } from "./plotly";

export interface ChartOnPaper {
  /** In the colours of light paper. */
  readonly figure: ChartFigure;
  /** The traces that the legend names: all of them where it is left out. */
  readonly legend?: readonly string[] | undefined;
  /** What colours stand for, with its unit: stands above the chart. */
  readonly colours?: string;
  /** Its numbers, where they are not its points. */
  readonly table?: readonly (readonly Value[])[];
}

interface Axis extends Readonly<Record<string, unknown>> {
  readonly title?: { readonly text: string };
}

type Value = number | string | null | undefined;

/** About as wide as a character is, as a part of the font's size. */
const CHARACTER = 0.62;
const MM_PER_POINT = 25.4 / 72;

/** Lines that end at commas, as long as there is room for. */
function inLines(text: string, { width, font }: PaperSize): string {
  const most = width / (CHARACTER * font * MM_PER_POINT);
  return text
    .split(", ")
    .reduce((lines, part) =>
      lines.length - lines.lastIndexOf(">") + part.length < most ? `${lines}, ${part}` : `${lines},<br>${part}`,
    );
}

const axesOf = ({ xaxis, yaxis }: PlotLayout): readonly [Axis, Axis] => [(xaxis ?? {}) as Axis, (yaxis ?? {}) as Axis];
const textOf = ({ title }: Axis) => title?.text ?? "";
const isGrid = (trace: AnyTrace): trace is GridTrace => trace.type === "heatmap";

/** With the axes as somebody has zoomed them in what is drawn. */
export function asZoomed(figure: ChartFigure, drawn: HTMLElement | null): ChartFigure {
  const layout = (drawn as PlotElement | null)?.layout;
  const [x, y] = axesOf(figure.layout);
  const zoomed = (axis: Axis, { range, autorange }: { readonly range?: unknown; readonly autorange?: unknown } = {}) =>
    range === undefined || autorange === true ? axis : { ...axis, range, autorange: false };
  return { ...figure, layout: { ...figure.layout, xaxis: zoomed(x, layout?.xaxis), yaxis: zoomed(y, layout?.yaxis) } };
}

const namesOf = ({ figure: { data }, legend = data.map(({ name }) => name) }: ChartOnPaper) => legend;

export function paperChart(chart: ChartOnPaper, size: PaperSize): PaperFigure {
  const {
    figure: { data, layout },
    colours,
  } = chart;
  const legend = namesOf(chart);
  const [x, y] = axesOf(layout);
  const page = sheet(layout, size, { ...x, text: textOf(x) }, { ...y, text: textOf(y) }, legend);
  const points = size.font * POINT;
  const margin = layout.margin as { readonly r?: number; readonly t?: number } | undefined;
  const annotations = (layout.annotations as readonly Readonly<Record<string, object>>[] | undefined) ?? [];
  // A strategy's line and its points have one name: one of them stands in the legend.
  const last = new Map(data.map(({ name }, index) => [name, index]));
  return {
    ...page,
    data: data.map((trace, index): AnyTrace => {
      if (isGrid(trace)) return { ...trace, colorbar: { thickness: 10, outlinewidth: 0, tickfont: { size: points } } };
      const { x: values } = trace as { readonly x: Values };
      return {
        ...trace,
        showlegend:
          ("bdata" in values || values.length > 0) && legend.includes(trace.name) && last.get(trace.name) === index,
      };
    }),
    layout: {
      ...page.layout,
      ...(colours !== undefined && {
        title: {
          text: inLines(colours, size),
          font: { size: points },
          x: 0,
          y: 1,
          xref: "paper",
          yref: "paper",
          yanchor: "bottom",
          pad: { b: 6 },
          automargin: true,
        },
      }),
      margin: { ...page.layout.margin, r: margin?.r ?? 8, t: margin?.t ?? 8 },
      annotations: annotations.map((each) => ({ ...each, font: { ...each.font, size: points } })),
    },
  };
}

const text = (value: Value) => (typeof value === "number" ? printed(value) : cell(value ?? ""));

/** Lines of `#` say where it comes from; below stand the cells of a map, or the points of each trace that the legend names. */
export function chartCsv(chart: ChartOnPaper, about: readonly string[]): string {
  const {
    figure: { data, layout },
    colours,
    table,
  } = chart;
  const legend = namesOf(chart);
  const [x, y] = axesOf(layout).map(textOf);
  const grid = data.find(isGrid);
  const dotted = new Set(data.flatMap((trace) => ("mode" in trace && trace.mode === "markers" ? [trace.name] : [])));
  const rows =
    table ??
    (grid
      ? [[x, y, colours], ...grid.y.flatMap((up, i) => grid.x.map((across, j) => [across, up, grid.z[i]?.[j]]))]
      : [
          ["", x, y],
          ...data
            .filter(({ name }) => legend.includes(name))
            .flatMap((trace) => pointsOf(trace, dotted).map((point) => [trace.name, ...point])),
        ]);
  return [...about.map(comment), ...rows.map((row) => row.map(text).join(",")), ""].join("\n");
}

/** A line that joins points has them a second time: `dotted` are the names of traces of points. */
function pointsOf(trace: AnyTrace, dotted: ReadonlySet<string | undefined>): readonly (readonly [Value, Value])[] {
  const isLine = !("mode" in trace) || trace.mode !== "markers";
  if (trace.type !== "scatter" || (isLine && dotted.has(trace.name))) return [];
  const { x, y } = trace as { readonly x: Values; readonly y: Values };
  const [across, up] = [listed(x), listed(y)];
  return across.flatMap((value, index) => (value === null ? [] : [[value, up[index]] as const])); // no value ends a line
}

type Values = readonly Value[] | Parameters<typeof decodeArray>[0];

const listed = (values: Values): readonly Value[] => ("bdata" in values ? [...decodeArray(values)] : values);
