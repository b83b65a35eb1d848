/** How a sweep is looked at. On its own page the address carries it; a link has its own. */

import { useNavigate, useSearch } from "@tanstack/react-router";
import { useState } from "react";
import type { SharedView, StrategyId } from "../../api/types";
import { listOf } from "../../lab/address";
import { OPENING_METRIC } from "../../server/metrics";

/** Runs over a field, a metric over two fields, or one metric over another. */
export type PlotKind = "points" | "map" | "trade_off";

const PLOT_KINDS: readonly PlotKind[] = ["points", "map", "trade_off"];

export interface BatchView {
  /** `null` for what suits the sweep. */
  readonly plot: PlotKind | null;
  /** Dotted name of a swept field; `null` for the first one. */
  readonly x: string | null;
  /** Column of a figure. */
  readonly y: string;
  readonly hidden: readonly StrategyId[];
  /** Whose map is drawn. */
  readonly strategy: StrategyId | null;
  /** The strategy it is compared with; `none`, or `null` for what suits the sweep. */
  readonly against: StrategyId | null;
  /** Where a map has a line, in the unit shown; `none`, or `null` for what suits the map. */
  readonly threshold: number | typeof NONE | null;
  /** Column of the figure on the x axis of a trade-off. */
  readonly versus: string | null;
}

/** Compared with nothing; without a line. */
export const NONE = "none";

export type BatchSearch = Partial<
  Record<"plot" | "x" | "y" | "hide" | "strategy" | "against" | "at" | "versus", string>
>;
type Change = (part: Partial<BatchView>) => void;

const kindOf = (text: string | null | undefined): PlotKind | null => PLOT_KINDS.find((kind) => kind === text) ?? null;

type Stated = Partial<Record<keyof BatchSearch, string | null | undefined>>;

export function viewOf({ plot, x, y, hide, strategy, against, at, versus }: Stated): BatchView {
  const threshold = at === NONE ? NONE : parseFloat(at ?? "");
  return {
    plot: kindOf(plot),
    x: x ?? null,
    y: y ?? OPENING_METRIC,
    hidden: listOf(hide ?? undefined),
    strategy: strategy ?? null,
    against: against ?? null,
    threshold: threshold === NONE || Number.isFinite(threshold) ? threshold : null,
    versus: versus ?? null,
  };
}

export const searchOf = ({ plot, x, y, hidden, strategy, against, threshold, versus }: BatchView): BatchSearch => ({
  ...(plot !== null && { plot }),
  ...(x !== null && { x }),
  ...(y !== OPENING_METRIC && { y }),
  ...(hidden.length > 0 && { hide: hidden.join(",") }),
  ...(strategy !== null && { strategy }),
  ...(against !== null && { against }),
  ...(threshold !== null && { at: String(threshold) }),
  ...(versus !== null && { versus }),
});

export function useBatchView(): readonly [BatchView, Change] {
  const view = viewOf(useSearch({ from: "/b/$id" }));
  const navigate = useNavigate();
  return [
    view,
    (part) => void navigate({ to: ".", search: searchOf({ ...view, ...part }), replace: true, resetScroll: false }),
  ];
}

export function useSharedView({ hidden, threshold, ...stated }: SharedView): readonly [BatchView, Change] {
  const [view, setView] = useState(() => viewOf({ ...stated, hide: hidden?.join(","), at: threshold?.toString() }));
  return [view, (part) => setView((before) => ({ ...before, ...part }))];
}
