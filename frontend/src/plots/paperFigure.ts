/** One figure as a paper or a slide takes it: a width in millimetres, a font size in points, light colours. */

import type { FigureTemplate } from "../api/types";
import { axisSignal, buildFigure, overRoads } from "./figure";
import type { Curves } from "./curves";
import { ON_PAPER } from "./palettes";
import { asText, loadPlotly, withPlainNames, type PlotLayout, type PlotTrace } from "./plotly";
import type { PaperFigure, PaperSize } from "./saved";

export const WIDTHS = [
  { value: "88", label: "88 mm, one column" },
  { value: "180", label: "180 mm, two columns" },
  { value: "254", label: "254 mm, slide" },
] as const;
export const FONT_SIZES = (["7", "8", "10", "14"] as const).map((value) => ({ value, label: `${value} pt` }));

export type Width = (typeof WIDTHS)[number]["value"];
export type FontSize = (typeof FONT_SIZES)[number]["value"];

const DPI = 300;
const MM = 96 / 25.4; // pixels of a style sheet
export const POINT = 96 / 72;
/** Wider figures are flatter. */
const heightOf = (width: number) => Math.round(width < 100 ? 0.72 * width : 0.45 * width);

/** What more than one row of names adds to the height, the curves keep theirs [mm]; plotly gives all names equal columns. */
function furtherRows(names: readonly string[], { width, font }: PaperSize): number {
  const size = font * POINT;
  const column = SYMBOL + LETTER * size * Math.max(0, ...names.map((name) => name.length));
  const columns = Math.max(1, Math.floor((width * MM) / column));
  return names.length === 0 ? 0 : ((Math.ceil(names.length / columns) - 1) * ROW * size) / MM;
}
const [SYMBOL, LETTER, ROW] = [40, 0.55, 1.4]; // pixels, and parts of the type size

/** The strategies in the colours of light paper, which the template has. */
export const onPaper = ({ data }: FigureTemplate, strategies: Curves["strategies"]) =>
  strategies.map((strategy) => {
    const colour = data.find(({ meta }) => meta.strategy === strategy.id)?.line?.color;
    return typeof colour === "string" ? { ...strategy, colour } : strategy;
  });

interface AxisOnPaper extends Readonly<Record<string, unknown>> {
  readonly text: string;
}

/** A figure's layout on paper: white, in one font, its axes with titles. */
export function sheet(
  layout: PlotLayout,
  paper: PaperSize,
  xaxis: AxisOnPaper,
  yaxis: AxisOnPaper,
  names: readonly string[],
) {
  const { width, font } = paper;
  const size = font * POINT;
  const axis = ({ text, ...rest }: AxisOnPaper) => ({
    ...rest,
    automargin: true,
    tickfont: { size },
    title: { text, font: { size }, standoff: 6 },
  });
  return {
    width,
    height: Math.round(heightOf(width) + furtherRows(names, paper)),
    layout: {
      ...layout,
      font: { family: "Arial, sans-serif", size, color: ON_PAPER.text },
      margin: { l: 8, r: 8, t: 8, b: 8 },
      paper_bgcolor: "#ffffff",
      plot_bgcolor: "#ffffff",
      xaxis: axis(xaxis),
      yaxis: axis(yaxis),
      showlegend: true,
      legend: { traceorder: "normal", orientation: "h", x: 0, y: 1.02, yanchor: "bottom", font: { size } },
    },
  };
}

export function paperFigure(template: FigureTemplate, curves: Curves, size: PaperSize): PaperFigure<PlotTrace> {
  const { meta } = template.layout;
  const { data, layout } = buildFigure({
    template,
    ...curves,
    strategies: onPaper(template, curves.strategies),
    palette: ON_PAPER,
  });
  const less = curves.minus === undefined ? "" : `, change against ${asText(curves.minus)}`;
  const roadsNote = curves.roads === undefined ? "" : `<br>${overRoads(curves.roads, curves.minus !== undefined)}`;
  const x = {
    ...layout.xaxis,
    tickmode: "auto",
    nticks: 7,
    text: `${meta.axes[axisSignal(curves.axis)] ?? ""}${roadsNote}`,
  };
  const y = { ...layout.yaxis, tickmode: "auto", nticks: 6, text: `${meta.title} [${meta.unit}]${less}` };
  const names = data.flatMap(({ name, showlegend }) => (name === undefined || showlegend === false ? [] : [name]));
  return { data: withPlainNames(data), ...sheet(layout, size, x, y, names) };
}

/** A drawing whose width and height are lengths, so that it is as large as asked for wherever it is placed. */
export function sized(svg: string, width: number, height: number): string {
  const [pixelsWide, pixelsHigh] = [Math.round(width * MM), Math.round(height * MM)];
  return svg.replace(/<svg[^>]*>/, (root) => {
    const unsized = root.replace(/ (?:width|height|viewBox)="[^"]*"/g, "");
    return unsized.replace(
      "<svg",
      `<svg width="${width}mm" height="${height}mm" viewBox="0 0 ${pixelsWide} ${pixelsHigh}"`,
    );
  });
}

const SVG = "data:image/svg+xml,";

export async function figureImage({ width, height, ...figure }: PaperFigure, format: "png" | "svg"): Promise<string> {
  const plotly = await loadPlotly();
  const size = { width: Math.round(width * MM), height: Math.round(height * MM) };
  const address = await plotly.toImage(figure, { format, ...size, scale: format === "png" ? DPI / 96 : 1 });
  return format === "png"
    ? address
    : SVG + encodeURIComponent(sized(decodeURIComponent(address.slice(SVG.length)), width, height));
}
