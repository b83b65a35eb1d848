/** plotly.js, loaded once and late, and the few types of it this page uses. */

import type { MadeTrace } from "../api/types";
import type { Numbers } from "../lib/samples";
import { createAtom } from "@tanstack/react-store";

export interface PlotTrace {
  readonly type: "scatter";
  readonly mode: "lines";
  readonly name?: string;
  readonly x: Numbers;
  readonly y: Numbers;
  readonly line: Readonly<Record<string, unknown>>;
  readonly opacity?: number;
  /** Fills up to the trace before it. */
  readonly fill?: "tonexty";
  readonly fillcolor?: string;
  readonly showlegend?: boolean;
}

/** Single runs as points. */
export interface PointTrace {
  readonly type: "scatter";
  readonly mode: "markers";
  readonly name: string;
  readonly x: readonly (number | string)[];
  readonly y: readonly (number | string)[];
  readonly marker: Options;
  readonly showlegend?: boolean;
  /** The table's row of each point. */
  readonly customdata: readonly number[];
  readonly text?: readonly string[];
  readonly hovertemplate?: string;
  readonly hoverinfo?: "skip";
}

/** What joins runs. */
export interface LineTrace {
  readonly type: "scatter";
  readonly mode: "lines";
  readonly name: string;
  readonly x: readonly (number | string | null)[];
  readonly y: readonly (number | null)[];
  readonly line: Options;
  readonly opacity: number;
  readonly showlegend?: boolean;
  readonly hoverinfo: "skip";
}

/** Counts, side by side. */
export interface BarTrace {
  readonly type: "bar";
  readonly name: string;
  readonly orientation?: "h";
  readonly x: readonly (number | string)[];
  readonly y: readonly (number | string)[];
  readonly width?: readonly number[];
  readonly showlegend?: boolean;
  readonly marker: Options;
  readonly text?: readonly string[];
  readonly textposition?: "none";
  readonly hovertemplate?: string;
}

/** Values over a grid, in colours or as a line where they are equal. */
export interface GridTrace {
  readonly type: "heatmap" | "contour";
  readonly name: string;
  readonly x: readonly (number | string)[];
  readonly y: readonly (number | string)[];
  readonly z: readonly (readonly (number | null)[])[];
  /** The table's row of each cell. */
  readonly customdata?: readonly (readonly (number | null)[])[];
  readonly text?: readonly (readonly string[])[];
  readonly hovertemplate?: string;
  readonly [option: string]: unknown;
}

export type AnyTrace = PlotTrace | PointTrace | LineTrace | BarTrace | GridTrace | MadeTrace;

export interface PlotFigure {
  readonly data: readonly PlotTrace[];
  readonly layout: PlotLayout;
}

type Options = Readonly<Record<string, unknown>>;

export interface PlotLayout extends Options {
  readonly shapes: readonly Options[];
}

export interface AxisOptions extends Options {
  readonly range: readonly [number, number];
  readonly tickvals: readonly number[];
  readonly ticktext: readonly string[];
  readonly color: string;
  readonly gridcolor: string;
  readonly zerolinecolor: string;
}

/** One panel: exactly one pair of axes. */
export interface PanelFigure extends PlotFigure {
  readonly layout: PlotLayout & { readonly xaxis: AxisOptions; readonly yaxis: AxisOptions };
}

/** Plotly reads texts as HTML, links included: what somebody has typed has to be shown as it stands. */
export const asText = (text: string): string => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

/** The names are texts. */
export const withPlainNames = (data: readonly PlotTrace[]): readonly PlotTrace[] =>
  data.map((trace) => (trace.name === undefined ? trace : { ...trace, name: asText(trace.name) }));

interface ImageOptions {
  readonly format: "png" | "svg";
  readonly width: number;
  readonly height: number;
  readonly scale?: number;
}

export interface Plotly {
  readonly react: (
    element: HTMLElement,
    data: readonly AnyTrace[],
    layout: PlotLayout,
    config: Readonly<Record<string, unknown>>,
  ) => Promise<unknown>;
  readonly purge: (element: HTMLElement) => void;
  readonly toImage: (
    figure: { readonly data: readonly AnyTrace[]; readonly layout: PlotLayout },
    options: ImageOptions,
  ) => Promise<string>;
}

interface DrawnAxis {
  readonly range?: readonly (number | string)[];
  readonly autorange?: boolean | string;
}

/** An element plotly has drawn in. */
export interface PlotElement extends HTMLElement {
  readonly on: {
    (
      event: "plotly_click",
      handler: (event: { readonly points: readonly { readonly customdata: number }[] }) => void,
    ): void;
    (event: "plotly_relayout", handler: () => void): void;
  };
  /** As drawn, with what somebody has zoomed to; there once something is drawn. */
  readonly layout?: { readonly xaxis?: DrawnAxis; readonly yaxis?: DrawnAxis };
  /** Gone once it is purged. */
  readonly removeAllListeners?: (event: "plotly_click" | "plotly_relayout") => void;
}

interface PlotlyState {
  readonly plotly: Plotly | null;
  /** The file could not be had; asking again may help. */
  readonly failed: boolean;
}

const state = createAtom<PlotlyState>({ plotly: null, failed: false });

export const plotlyState = { get: state.get, subscribe: state.subscribe };

let loading: Promise<Plotly> | null = null;

/** Its own types leave out what we freeze. */
const bundle = () => import("./charts") as unknown as Promise<{ readonly default: Plotly }>;

/** Loads it once; after a failure the next call tries again. */
export function loadPlotly(load = bundle): Promise<Plotly> {
  loading ??= load().then(
    async ({ default: plotly }) => {
      await new Promise((resolve) => setTimeout(resolve)); // evaluated in one task, it draws in the next
      state.set({ plotly, failed: false });
      return plotly;
    },
    (error: unknown) => {
      loading = null;
      state.set({ plotly: null, failed: true });
      throw error;
    },
  );
  return loading;
}

/** Asks for it; `plotlyState` says what came of it. */
export function requestPlotly(): void {
  loadPlotly().catch(() => undefined);
}
