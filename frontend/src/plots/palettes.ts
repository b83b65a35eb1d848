/** What plots draw their axes with, by colour scheme. */

import type { LineTrace, PlotLayout, PointTrace } from "./plotly";

export interface Palette {
  readonly text: string;
  readonly grid: string;
  readonly zero: string;
}

export const PALETTES: Readonly<Record<"light" | "dark", Palette>> = {
  light: { text: "#4a555b", grid: "rgba(120, 135, 142, 0.2)", zero: "rgba(120, 135, 142, 0.55)" },
  dark: { text: "#a9b3b9", grid: "rgba(140, 150, 156, 0.2)", zero: "rgba(140, 150, 156, 0.5)" },
};

/** What is printed or stands in a paper. */
export const ON_PAPER: Palette = {
  text: "#333c41",
  grid: "rgba(120, 135, 142, 0.25)",
  zero: "rgba(120, 135, 142, 0.6)",
};

/** What every chart apart from the lab's panels has in common. */
export function chartLayout(
  palette: Palette,
  { xaxis, yaxis, ...rest }: { readonly xaxis: object; readonly yaxis: object; readonly [name: string]: unknown },
): PlotLayout {
  const axis = {
    color: palette.text,
    gridcolor: palette.grid,
    zeroline: false,
    automargin: true,
    ticklabeloverflow: "allow", // else each label is measured, which takes a quarter of a drawing
  };
  return {
    font: { family: "inherit", color: palette.text, size: 12 },
    margin: { l: 56, r: 16, t: 10, b: 48 },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    showlegend: false,
    hovermode: "closest",
    hoverlabel: { align: "left" },
    shapes: [],
    ...rest,
    xaxis: { ...axis, ...xaxis },
    yaxis: { ...axis, ...yaxis },
  };
}

/** Across the whole plot at a value of one of its axes, and what is said of it at its end. */
export function referenceLine(palette: Palette, axis: "x" | "y", value: number, text: string, xanchor: string) {
  const other = axis === "x" ? "y" : "x";
  const line = { color: palette.text, width: 1.5, dash: "dash" };
  const font = { size: 11, color: palette.text };
  const across = { [`${other}ref`]: "paper" };
  return {
    shapes: [
      { type: "line", [`${axis}0`]: value, [`${axis}1`]: value, [`${other}0`]: 0, [`${other}1`]: 1, ...across, line },
    ],
    annotations: [{ text, [axis]: value, [other]: 1, ...across, xanchor, yanchor: "bottom", showarrow: false, font }],
  };
}

/** Lines and points that answer no pointer. */
export const lineTrace = (
  name: string,
  { x, y, ...line }: Pick<LineTrace, "x" | "y"> & LineTrace["line"],
  opacity = 1,
): LineTrace => ({ type: "scatter", mode: "lines", name, x, y, line, opacity, hoverinfo: "skip" });

export const pointTrace = (
  name: string,
  { x, y, ...marker }: Pick<PointTrace, "x" | "y"> & PointTrace["marker"],
): PointTrace => ({ type: "scatter", mode: "markers", name, x, y, marker, customdata: [], hoverinfo: "skip" });
