/** Fills a figure template with series: what plotly draws in one panel. Pure, so that it can be tested and exported. */

import { stepAbove, stepBelow } from "../lib/steps";
import { maximumOf, minimumOf } from "../api/decode";
import type { Axis, Zoom } from "../lab/address";
import type { FigureInput, Layer } from "./curves";
import type { Palette } from "./palettes";
import type { PanelFigure, PlotTrace } from "./plotly";
import { covering, extent, type Numbers } from "../lib/samples";
import { airborneShapes, referenceShapes, referenceValues, stageShapes, type Shape } from "./shapes";

export const MARGIN = { l: 46, r: 10, t: 6, b: 22 } as const;

export const axisSignal = (axis: Axis) => (axis === "distance" ? "position" : "time");
export const axisUnit = (axis: Axis) => (axis === "distance" ? "m" : "s");

/** What curves over several roads are, in words. */
export const overRoads = (roads: number, isDifference: boolean) =>
  isDifference ? `Differences of the means of ${roads} roads` : `Mean of ${roads} roads; range: minimum to maximum`;

function scaled(values: Numbers, factor: number): Numbers {
  return factor === 1 ? values : values.map((value) => value * factor);
}

function traces(input: FigureInput): readonly PlotTrace[] {
  const layers = [...(input.layers ?? []), { name: "", series: input.series, line: {}, opacity: 1 }];
  return [...bandTraces(input), ...layers.flatMap((layer) => tracesOf(input, layer))];
}

/** Of a band's colour behind its curve, in two hexadecimal digits: three of them over each other can still be told apart. */
const BAND_OPACITY = "3d";

/** From the smallest to the largest value over the roads, for each strategy that has them: two edges, filled in between. */
function bandTraces({ template, series, strategies, axis, range, isolated = null }: FigureInput): readonly PlotTrace[] {
  const { scale } = template.layout.meta;
  return template.data.flatMap(({ name, meta: { strategy, signal } }): PlotTrace[] => {
    const own = series[strategy];
    const x = own?.[axisSignal(axis)];
    const [low, high] = [own?.[minimumOf(signal)], own?.[maximumOf(signal)]];
    const drawn = strategies.find(({ id }) => id === strategy);
    if (!x || !low || !high || !drawn || (isolated !== null && isolated !== strategy)) return [];
    const [from, to] = covering(x, range[0], range[1]);
    const edge = (what: string, values: Numbers, fill: Partial<PlotTrace>): PlotTrace => ({
      type: "scatter",
      mode: "lines",
      ...(name === undefined ? {} : { name: `${name}, ${what}` }),
      x: x.subarray(from, to),
      y: scaled(values.subarray(from, to), scale),
      line: { width: 0 },
      showlegend: false,
      ...fill,
    });
    return [
      edge("minimum", low, {}),
      edge("maximum", high, { fill: "tonexty", fillcolor: `${drawn.colour}${BAND_OPACITY}` }),
    ];
  });
}

/** A line of one pixel takes a fifth of the time where no graphics card draws it. */
const LIVE = { width: 1 };

/** A curve beside the one that stands out. */
const FADED = 0.12;

function tracesOf(
  { template, strategies, axis, range, palette, isolated = null, live = false }: FigureInput,
  { name, series, line, grey = false, opacity }: Layer,
): readonly PlotTrace[] {
  const { scale } = template.layout.meta;
  return template.data.flatMap((trace): PlotTrace[] => {
    const { strategy, signal } = trace.meta;
    const x = series[strategy]?.[axisSignal(axis)];
    const y = series[strategy]?.[signal];
    const drawn = strategies.find(({ id }) => id === strategy);
    if (!x || !y || !drawn) return [];
    const [from, to] = covering(x, range[0], range[1]);
    return [
      {
        type: "scatter",
        mode: "lines",
        ...(trace.name === undefined ? {} : { name: name === "" ? trace.name : `${trace.name}, ${name}` }),
        x: x.subarray(from, to),
        y: scaled(y.subarray(from, to), scale),
        line: { ...trace.line, color: grey ? palette.text : drawn.colour, ...line, ...(live && LIVE), simplify: true },
        opacity: isolated === null || isolated === strategy ? opacity : FADED,
      },
    ];
  });
}

/** How far beyond the curves, in spans of theirs, a reference line may lie and still be brought into view. */
const REACH = 0.6;
const PADDING = 0.02;
const EDGE = 0.3;

/** Zoomed in, an axis spans at least this part of the whole run's values: noise must not look like motion. */
const LEAST_SPAN = 0.02;

function wholeSpan({ template, series, strategies }: FigureInput): number {
  const { signal, scale } = template.layout.meta;
  const spans = strategies.map(({ id }) => extent(series[id]?.[signal] ?? NOTHING)).filter((span) => span !== null);
  return spans.length === 0
    ? 0
    : scale * (Math.max(...spans.map(([, top]) => top)) - Math.min(...spans.map(([low]) => low)));
}

const NOTHING = new Float32Array();

export function verticalRange(
  data: readonly PlotTrace[],
  references: readonly number[],
  whole: number,
  leastSpan: number,
): readonly [number, number] {
  const spans = data.map(({ y }) => extent(y)).filter((span) => span !== null);
  if (spans.length === 0) return [-1, 1];
  let low = Math.min(...spans.map(([bottom]) => bottom));
  let high = Math.max(...spans.map(([, top]) => top));
  const margin = REACH * Math.max(high - low, Number.MIN_VALUE);
  const near = references.filter((value) => value >= low - margin && value <= high + margin);
  low = Math.min(low, ...near);
  high = Math.max(high, ...near);
  const size = Math.max(Math.abs(low), Math.abs(high));
  // A curve that never moves still gets an axis with room around it.
  const least = Math.max(leastSpan, LEAST_SPAN * whole) || (size > 0 ? size : 1);
  const missing = Math.max(0, least - (high - low)) / 2;
  const span = high - low + 2 * missing;
  return rounded(low - missing - PADDING * span, high + missing + PADDING * span);
}

/** Outwards to multiples of a tenth of the span (1, 2 or 5 × 10ⁿ), so that small changes leave the axis alone. */
function rounded(low: number, high: number): readonly [number, number] {
  const step = stepBelow((high - low) / 10);
  // A little beyond, or the outermost label would stand in the corner of both axes.
  return [Math.floor(low / step) * step - EDGE * step, Math.ceil(high / step) * step + EDGE * step];
}

const [X_TICKS, Y_TICKS] = [8, 6];

export function marked(range: Zoom, most: number, suffix = "") {
  const { values, texts } = ticksFor(range, most, suffix);
  return { range, tickvals: values, ticktext: texts };
}

/** The same figure over another vertical range. */
export function withVerticalRange(figure: PanelFigure, range: Zoom): PanelFigure {
  return { ...figure, layout: { ...figure.layout, yaxis: { ...figure.layout.yaxis, ...marked(range, Y_TICKS) } } };
}

export function buildFigure(input: FigureInput): PanelFigure {
  const { template, summaries, strategies, axis, range, palette } = input;
  const { meta } = template.layout;
  const data = traces(input);
  const ids = strategies.map(({ id }) => id);
  const used = ids.flatMap((id) => summaries[id] ?? []);
  const shapes: readonly Shape[] = [...stageShapes(input), ...airborneShapes(input), ...referenceShapes(meta, used)];
  const vertical = verticalRange(data, referenceValues(meta, used), wholeSpan(input), meta.least_span);
  const xaxis = marked(range, X_TICKS, ` ${axisUnit(axis)}`);
  return { data, layout: panelLayout(palette, xaxis, marked(vertical, input.yTicks ?? Y_TICKS), shapes) };
}

type Marked = ReturnType<typeof marked>;

export function panelLayout(
  palette: Palette,
  xaxis: Marked,
  yaxis: Marked,
  shapes: readonly Shape[],
): PanelFigure["layout"] {
  const axisStyle = {
    color: palette.text,
    gridcolor: palette.grid,
    zerolinecolor: palette.zero,
    tickfont: { size: 11 },
    tickmode: "array",
  };
  return {
    font: { family: "inherit", color: palette.text },
    margin: MARGIN,
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    showlegend: false,
    hovermode: false,
    dragmode: false,
    xaxis: { ...axisStyle, ...xaxis, zeroline: false },
    yaxis: { ...axisStyle, ...yaxis, zeroline: true },
    shapes,
  };
}

type Range = readonly [number, number];

/** Where an axis has its marks and what they say: one definition for plotly and for the canvas. */
interface Ticks {
  readonly values: readonly number[];
  readonly texts: readonly string[];
}

/** At most about `most` multiples of 1, 2 or 5 × 10ⁿ; the last one carries the unit. */
export function ticksFor([low, high]: Range, most: number, suffix = ""): Ticks {
  const step = stepAbove((high - low) / most);
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.max(0, Math.floor(high / step + 1e-9) - first + 1);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const values = Array.from({ length: count }, (_, index) => (first + index) * step);
  const texts = values.map((value, index) => labelOf(value, decimals) + (index === count - 1 ? suffix : ""));
  return { values, texts };
}

function labelOf(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? "0" : text.replace("-", "−");
}
