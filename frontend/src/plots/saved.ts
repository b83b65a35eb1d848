/** What a figure's file is made of, whichever plot it is of. */

import type { AnyTrace, PlotLayout } from "./plotly";

export interface PaperSize {
  /** [mm] */
  readonly width: number;
  /** [pt] */
  readonly font: number;
}

export interface PaperFigure<Trace extends AnyTrace = AnyTrace> {
  /** [mm] */
  readonly width: number;
  readonly height: number;
  readonly data: readonly Trace[];
  readonly layout: PlotLayout;
}

export interface FigureSource {
  readonly title: string;
  /** Name of the file without its ending. */
  readonly file: string;
  readonly paper: (size: PaperSize) => Promise<PaperFigure>;
  readonly csv: () => Promise<string>;
}
