/** All shown plots as one picture. */

import type { FigureTemplates } from "../../api/types";
import { buildFigure, axisUnit, overRoads } from "../../plots/figure";
import { ownLaws, type Curves } from "../../plots/curves";
import { ON_PAPER } from "../../plots/palettes";
import { onPaper } from "../../plots/paperFigure";
import { asText, loadPlotly, withPlainNames, type PlotFigure } from "../../plots/plotly";

const WIDTH = 1200;
const PANEL_HEIGHT = 190;
/** Room for the line at the foot that says where the picture comes from. */
const FOOT = 34;
const LINE = 15;
const GAP = 0.28; // of a panel, for its title

/** One figure with a row for each panel over one x axis. */
function stackFigures(figures: FigureTemplates, curves: Curves): PlotFigure & { readonly height: number } {
  const templates = Object.values(figures);
  const { axis, minus, roads, runId, coreVersion } = curves;
  const row = 1 / templates.length;
  const built = templates.map((template) =>
    buildFigure({
      template,
      ...curves,
      isolated: null,
      strategies: onPaper(template, curves.strategies),
      palette: ON_PAPER,
    }),
  );
  const name = (letter: "x" | "y", index: number) => (index === 0 ? letter : `${letter}${index + 1}`);
  const axes: Record<string, unknown> = {};
  built.forEach(({ layout }, index) => {
    const top = 1 - index * row;
    const suffix = index === 0 ? "" : String(index + 1);
    axes[`xaxis${suffix}`] = { ...layout.xaxis, anchor: name("y", index) };
    axes[`yaxis${suffix}`] = {
      ...layout.yaxis,
      anchor: name("x", index),
      domain: [top - row * (1 - GAP), top - row * 0.12],
    };
  });
  const data = built.flatMap((figure, index) =>
    withPlainNames(figure.data).map((trace) => ({
      ...trace,
      xaxis: name("x", index),
      yaxis: name("y", index),
      showlegend: index === 0 && trace.showlegend !== false,
    })),
  );
  const shapes = built.flatMap(({ layout }, index) =>
    layout.shapes.map((shape) => ({
      ...shape,
      xref: shape.xref === "paper" ? `${name("x", index)} domain` : name("x", index),
      yref: shape.yref === "paper" ? `${name("y", index)} domain` : name("y", index),
    })),
  );
  const annotations: Readonly<Record<string, unknown>>[] = templates.map(({ layout: { meta } }, index) => ({
    text: `<b>${meta.title}</b> [${meta.unit}]${minus === undefined ? "" : `, less ${asText(minus)}`}`,
    xref: "paper",
    yref: "paper",
    x: 0,
    y: 1 - index * row - row * 0.1,
    xanchor: "left",
    yanchor: "bottom",
    showarrow: false,
    font: { size: 13, color: ON_PAPER.text },
  }));
  const source = `Ridelab core ${coreVersion}${runId === null ? ", a live preview" : `, run ${runId}`}`;
  const laws = ownLaws(curves).map(asText);
  const foot = FOOT + LINE * laws.length;
  annotations.push({
    text: [source, ...laws].join("<br>"),
    align: "left",
    xref: "paper",
    yref: "paper",
    x: 0,
    y: 0,
    xanchor: "left",
    yanchor: "top",
    yshift: -30,
    showarrow: false,
    font: { size: 11, color: ON_PAPER.text },
  });
  return {
    data,
    height: PANEL_HEIGHT * templates.length + foot,
    layout: {
      ...axes,
      shapes,
      annotations,
      title: {
        text: `Ridelab: time histories over ${axis} [${axisUnit(axis)}]${roads === undefined ? "" : `. ${overRoads(roads, minus !== undefined)}`}`,
        font: { size: 15 },
        x: 0.03,
      },
      font: { family: "Arial, sans-serif", color: ON_PAPER.text },
      paper_bgcolor: "#ffffff",
      plot_bgcolor: "#ffffff",
      margin: { l: 60, r: 20, t: 70, b: 30 + foot },
      showlegend: true,
      legend: { traceorder: "normal", orientation: "h", y: 1, yanchor: "bottom", x: 1, xanchor: "right" },
    },
  };
}

export async function plotsImage(figures: FigureTemplates, curves: Curves, format: "png" | "svg"): Promise<string> {
  const { height, ...figure } = stackFigures(figures, curves);
  const plotly = await loadPlotly();
  return plotly.toImage(figure, { format, width: WIDTH, height, scale: format === "png" ? 2 : 1 });
}
