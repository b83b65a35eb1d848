/** The drawn part of a panel: plotly's graph, and the canvas that stands in for it. */

import { useElementSize } from "@mantine/hooks";
import { useEffect, useRef } from "react";
import type { PanelFigure, Plotly } from "./plotly";
import classes from "./plots.module.css";
import { clearCanvas, drawOnCanvas, type Size } from "./canvas";
import { withVerticalRange } from "./figure";

interface Props {
  readonly plotly: Plotly | null;
  readonly figure: PanelFigure | null;
  readonly live: boolean;
}

export function Surface({ plotly, figure, live }: Props) {
  const { ref: sizeRef, width, height } = useElementSize<HTMLDivElement>();
  const host = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useRef<PanelPainter>(null);

  useEffect(() => {
    if (!host.current || !canvas.current) return undefined;
    const panelPainter = new PanelPainter(host.current, canvas.current);
    painter.current = panelPainter;
    return () => {
      painter.current = null;
      panelPainter.dispose();
    };
  }, []);

  useEffect(() => {
    if (figure && width > 0) painter.current?.paint(figure, { width, height }, live, plotly);
  }, [plotly, figure, live, width, height]);

  return (
    <div ref={sizeRef} className={classes.surface}>
      <div ref={host} className={classes.graph} />
      <canvas ref={canvas} className={classes.live} aria-hidden />
    </div>
  );
}

type Range = readonly [number, number];

const CONFIG = { staticPlot: true, displayModeBar: false, responsive: false } as const;
/** A range already shown is kept while live curves fit in and fill at least this part of it: axes must not flicker. */
const LEAST_FILLED = 0.55;

/**
 * Paints one panel. An exact result is plotly's; while a slider moves, and until plotly is there, a canvas draws the same
 * figure: a plotly redraw of every panel would allow four frames a second.
 */
export function keepsRange(drawn: Range | null, needed: Range): boolean {
  if (drawn === null) return false;
  const fits = needed[0] >= drawn[0] && needed[1] <= drawn[1];
  return fits && needed[1] - needed[0] >= LEAST_FILLED * (drawn[1] - drawn[0]);
}

class PanelPainter {
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
