/**
 * Paints one panel. An exact result is plotly's; while a slider moves, and until plotly is there, a canvas draws the same
 * figure: a plotly redraw of every panel would allow four frames a second.
 */

import { clearCanvas, drawOnCanvas, type Size } from "./canvas";
import { withVerticalRange } from "./figure";
import type { PanelFigure, Plotly } from "./plotly";

type Range = readonly [number, number];

const CONFIG = { staticPlot: true, displayModeBar: false, responsive: false } as const;
/** A range already shown is kept while live curves fit in and fill at least this part of it: axes must not flicker. */
const LEAST_FILLED = 0.55;

export function keepsRange(drawn: Range | null, needed: Range): boolean {
  if (drawn === null) return false;
  const fits = needed[0] >= drawn[0] && needed[1] <= drawn[1];
  return fits && needed[1] - needed[0] >= LEAST_FILLED * (drawn[1] - drawn[0]);
}

export class PanelPainter {
  readonly #host: HTMLElement;
  readonly #canvas: HTMLCanvasElement;
  #plotly: Plotly | null = null;
  #drawn: Range | null = null;

  constructor(host: HTMLElement, canvas: HTMLCanvasElement) {
    this.#host = host;
    this.#canvas = canvas;
  }

  paint(figure: PanelFigure, size: Size, live: boolean, plotly: Plotly | null): void {
    this.#plotly = plotly;
    const needed = figure.layout.yaxis.range;
    const range = live && this.#drawn !== null && keepsRange(this.#drawn, needed) ? this.#drawn : needed;
    this.#drawn = range;
    if (plotly && !live) this.#paintWithPlotly(plotly, figure, size);
    else {
      drawOnCanvas(this.#canvas, range === needed ? figure : withVerticalRange(figure, range), size);
      this.#host.dataset.drawn = "canvas";
    }
  }

  dispose(): void {
    this.#plotly?.purge(this.#host);
  }

  #paintWithPlotly(plotly: Plotly, figure: PanelFigure, size: Size): void {
    void plotly.react(this.#host, figure.data, { ...figure.layout, ...size }, CONFIG);
    this.#host.dataset.drawn = "plotly";
    clearCanvas(this.#canvas);
  }
}
