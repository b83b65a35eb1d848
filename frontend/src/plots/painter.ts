/**
 * Paints one panel. An exact result is plotly's alone. While a slider moves, plotly keeps the axes and a canvas over
 * them takes the curves: a full plotly redraw of every panel would allow four frames a second, this allows twenty.
 */

import { clearCanvas, drawOnCanvas, type Size } from "./canvas";
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
  readonly #plotly: Plotly;
  readonly #host: HTMLElement;
  readonly #canvas: HTMLCanvasElement;
  #drawn: Range | null = null;
  #axes = "";

  constructor(plotly: Plotly, host: HTMLElement, canvas: HTMLCanvasElement) {
    this.#plotly = plotly;
    this.#host = host;
    this.#canvas = canvas;
  }

  paint(figure: PanelFigure, size: Size, live: boolean): void {
    if (live) this.#paintLive(figure, size);
    else this.#paintExact(figure, size);
  }

  dispose(): void {
    this.#plotly.purge(this.#host);
  }

  #paintExact(figure: PanelFigure, size: Size): void {
    this.#drawn = figure.layout.yaxis.range;
    this.#axes = axesOf(figure, size, this.#drawn);
    void this.#plotly.react(this.#host, figure.data, { ...figure.layout, ...size }, CONFIG);
    delete this.#host.dataset.live;
    clearCanvas(this.#canvas);
  }

  #paintLive(figure: PanelFigure, size: Size): void {
    const needed = figure.layout.yaxis.range;
    const range = this.#drawn !== null && keepsRange(this.#drawn, needed) ? this.#drawn : needed;
    const axes = axesOf(figure, size, range);
    if (axes !== this.#axes) {
      const yaxis = { ...figure.layout.yaxis, range };
      void this.#plotly.react(this.#host, [], { ...figure.layout, ...size, yaxis, shapes: [] }, CONFIG);
      this.#axes = axes;
      this.#drawn = range;
    }
    this.#host.dataset.live = "";
    drawOnCanvas(this.#canvas, figure, size, figure.layout.xaxis.range, range);
  }
}

/** All that plotly's axes depend on. */
function axesOf({ layout }: PanelFigure, size: Size, range: Range): string {
  return JSON.stringify([layout.xaxis, { ...layout.yaxis, range }, size]);
}
