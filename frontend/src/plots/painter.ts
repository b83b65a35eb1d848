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

export function keepsRange(held: Range | null, wanted: Range): boolean {
  if (held === null) return false;
  const fits = wanted[0] >= held[0] && wanted[1] <= held[1];
  return fits && wanted[1] - wanted[0] >= LEAST_FILLED * (held[1] - held[0]);
}

export class PanelPainter {
  readonly #plotly: Plotly;
  readonly #host: HTMLElement;
  readonly #canvas: HTMLCanvasElement;
  #held: Range | null = null;
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
    this.#held = figure.layout.yaxis.range;
    this.#axes = axesOf(figure, size, this.#held);
    void this.#plotly.react(this.#host, figure.data, { ...figure.layout, ...size }, CONFIG);
    delete this.#host.dataset.live;
    clearCanvas(this.#canvas);
  }

  #paintLive(figure: PanelFigure, size: Size): void {
    const wanted = figure.layout.yaxis.range;
    const range = this.#held !== null && keepsRange(this.#held, wanted) ? this.#held : wanted;
    const axes = axesOf(figure, size, range);
    if (axes !== this.#axes) {
      const yaxis = { ...figure.layout.yaxis, range };
      void this.#plotly.react(this.#host, [], { ...figure.layout, ...size, yaxis, shapes: [] }, CONFIG);
      this.#axes = axes;
      this.#held = range;
    }
    this.#host.dataset.live = "";
    drawOnCanvas(this.#canvas, figure, size, figure.layout.xaxis.range, range);
  }
}

/** All that plotly's axes depend on. */
function axesOf({ layout }: PanelFigure, size: Size, range: Range): string {
  return JSON.stringify([layout.xaxis, { ...layout.yaxis, range }, size]);
}
