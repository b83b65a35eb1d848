/** What every chart apart from the lab's panels has in common. */

import type { Palette } from "./palettes";
import type { PlotLayout } from "./plotly";

export function chartLayout(
  palette: Palette,
  { xaxis, yaxis, ...rest }: { readonly xaxis: object; readonly yaxis: object; readonly [name: string]: unknown },
): PlotLayout {
  const axis = { color: palette.text, gridcolor: palette.grid, zeroline: false, automargin: true };
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
