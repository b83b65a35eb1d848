/** What panels draw: the shown curves, and under them those of the state before the last edit (thin) and of pins (each with a dash). */

import { createAtom, shallow, type ReadonlyAtom } from "@tanstack/react-store";
import type { FigureTemplate, SeriesByStrategy, Strategy, StrategyId, Summary } from "../api/types";
import type { Axis, Zoom } from "../lab/address";
import type { ResultView } from "../lab/resultView";
import type { Palette } from "./palettes";

export interface Layer {
  /** Behind the strategy's name. */
  readonly name: string;
  readonly series: SeriesByStrategy;
  /** In place of the strategy's own. */
  readonly line: Readonly<{ width?: number; dash?: string }>;
  /** In the axes' grey, whatever the strategy's colour. */
  readonly grey?: boolean;
  readonly opacity: number;
}

/** By pin, in their order; the list of pins shows the same. */
const PIN_DASHES: readonly string[] = ["2,2", "8,3", "5,2,1,2", "1,3", "12,3", "8,2,1,2,1,2", "3,6", "16,4"];

export const BEFORE_WIDTH = 1;
export const PIN_WIDTH = 1.2;

export const pinDash = (index: number): string => PIN_DASHES[index % PIN_DASHES.length] ?? "2,2";

export function layersOf(
  { before, pins }: Pick<ResultView, "before" | "pins">,
  runId: string | null,
): readonly Layer[] {
  const ghost = before
    ? [{ name: before.name, series: before.shown.series, line: { width: BEFORE_WIDTH }, grey: true, opacity: 0.65 }]
    : [];
  // A pinned result that is what is shown has no curves beside those.
  const others = pins.filter((pin) => pin.shown.runId === null || pin.shown.runId !== runId);
  const pinned = others.map(({ name, shown: { series }, index = 0 }) => ({
    name,
    series,
    line: { width: PIN_WIDTH, dash: pinDash(index) },
    opacity: 0.8,
  }));
  return [...ghost, ...pinned];
}

export interface FigureInput {
  readonly template: FigureTemplate;
  readonly series: SeriesByStrategy;
  /** What was driven, which shades the stages; `series` where that is no difference. */
  readonly sourceSeries: SeriesByStrategy;
  /** Curves of other variants, under those of `series`. */
  readonly layers?: readonly Layer[];
  readonly summaries: Readonly<Record<StrategyId, Summary>>;
  /** The one that stands out: the others fade. */
  readonly isolated?: StrategyId | null;
  /** In the order of drawing. */
  readonly strategies: readonly Pick<Strategy, "id" | "colour">[];
  readonly axis: Axis;
  /** Range of the shared axis. */
  readonly range: Zoom;
  readonly palette: Palette;
  /** The curves follow a slider. */
  readonly live?: boolean;
  /** At most about so many marks on the vertical axis. */
  readonly yTicks?: number;
}

/** What all panels draw, and nothing else of the result view: whatever else changes there, no curve is drawn anew. */
export interface Curves {
  readonly series: SeriesByStrategy;
  readonly sourceSeries: SeriesByStrategy;
  readonly layers?: readonly Layer[];
  readonly summaries: Readonly<Record<StrategyId, Summary>>;
  readonly strategies: readonly Strategy[];
  readonly axis: Axis;
  readonly range: Zoom;
  readonly isolated?: StrategyId | null;
  readonly live: boolean;
  /** `null` while it is a preview. */
  readonly runId: string | null;
  readonly coreVersion: string;
  /** Over how many roads the curves are means. */
  readonly roads?: number;
  /** What the curves are differences to. */
  readonly minus?: string;
  /** Finer samples of them are on their way. */
  readonly waiting?: boolean;
  /** Why samples that are needed could not be had. */
  readonly failure?: Error | null;
}

/** Curves that change without anything being rendered anew. */
export type CurvesSource = Pick<ReadonlyAtom<Curves>, "get" | "subscribe">;

/** Those of the lab's panels, while there are any. */
export const shownCurves = createAtom<CurvesSource | null>(null);

/**
 * What the lab's panels draw, once they wait for nothing.
 *
 * @throws There are no panels, they go away before, or their samples cannot be had.
 */
export const settledCurves = (): Promise<Curves> =>
  new Promise((resolve, reject) => {
    const source = shownCurves.get();
    const following = [shownCurves.subscribe(settle), source?.subscribe(settle)];
    function settle() {
      const curves = source !== null && shownCurves.get() === source ? source.get() : null;
      if (curves?.waiting) return;
      for (const each of following) each?.unsubscribe();
      if (curves === null) reject(new Error("No plots are shown."));
      else if (curves.failure) reject(curves.failure);
      else resolve(curves);
    }
    settle();
  });

type DrawnParts = Pick<Curves, "strategies" | "range" | "layers">;

const flat = ({ strategies, range, layers = [], ...rest }: DrawnParts) => [
  ...[...strategies, ...range, ...layers],
  ...Object.values(rest),
];

/** Whether nothing is to be drawn anew. */
export const sameCurves = <Part extends DrawnParts>(one: Part, other: Part) => shallow(flat(one), flat(other));

/** Of each controller of one's own its id, its file and that one's digest. */
export const ownLaws = ({ strategies, summaries }: Pick<Curves, "strategies" | "summaries">): readonly string[] =>
  strategies.flatMap(({ id }) => {
    const source = summaries[id]?.source;
    return source ? `${id}: ${source.file}, ${source.digest}` : [];
  });

/** Name of a figure's file without its ending. */
export const fileOf = (template: FigureTemplate, { runId }: Pick<Curves, "runId">) =>
  `ridelab-${runId ?? "live"}-${template.layout.meta.signal}`;
