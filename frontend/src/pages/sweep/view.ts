/** How a sweep is looked at: on its own page the address carries it, a link has its own; what its plot shows of that, and a run in words. */

import { useNavigate, useSearch } from "@tanstack/react-router";
import { useMemo, useState } from "react";
import { SEED } from "../../scenario/fields";
import type { SharedView, StrategyId, Batch, Strategy, Catalogue } from "../../api/types";
import { listOf } from "../../lab/address";
import { OPENING_METRIC, type Metric, fullName } from "../../server/metrics";
import { axesOf, type Columns, cell, REQUIRED, showCell } from "../../features/sweep/table";
import { markersOf } from "../../plots/markers";
import { useStrategies } from "../../server/useCatalogues";
import { CAVEAT_EVENTS, caveatsOf, type Caveat } from "../../features/tables/change";
import { formatResult, isNothing, prettyUnit } from "../../units/format";

/** Runs over a field, a metric over two fields, or one metric over another. */
export type PlotKind = "points" | "map" | "trade_off";

export interface BatchView {
  /** `null` for what suits the sweep. */
  readonly plot: "trade_off" | null;
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

type BatchSearch = Partial<Record<"plot" | "x" | "y" | "hide" | "strategy" | "against" | "at" | "versus", string>>;
type Change = (part: Partial<BatchView>) => void;

type Stated = Partial<Record<keyof BatchSearch, string | null | undefined>>;

export function viewOf({ plot, x, y, hide, strategy, against, at, versus }: Stated): BatchView {
  const threshold = at === NONE ? NONE : parseFloat(at ?? "");
  return {
    plot: plot === "trade_off" ? plot : null,
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

export type ShownPlot = NonNullable<ReturnType<typeof shownPlot>>;

const PASSIVE = "passive";
const TRADED = "travel_time";

export function shownPlot(
  batch: Pick<Batch, "fields" | "sweep">,
  strategies: readonly Strategy[],
  figures: readonly Metric[],
  view: BatchView,
) {
  const all = axesOf(batch.fields);
  const varied = all.filter(({ name }) => name !== SEED);
  // Two fields are swept, over a grid, on one road or several.
  const mappable = varied.length === 2 && !batch.sweep.latin_hypercube;
  const defaultKind: PlotKind = mappable ? "map" : "points";
  const kind = view.plot ?? defaultKind;
  const axes = kind === "map" ? varied : all;
  const find = (key: string | null) => figures.find((figure) => figure.key === key);
  const x = axes.find(({ name }) => name === view.x) ?? axes[0];
  const y = find(view.y) ?? find(OPENING_METRIC) ?? figures[0];
  const ids = strategies.map(({ id }) => id);
  const strategy = ids.find((id) => id === view.strategy) ?? ids[0];
  if (!x || !y || strategy === undefined) return null;
  const usual = ids.find((id) => id === PASSIVE && id !== strategy) ?? null;
  const against = view.against === null ? usual : (ids.find((id) => id === view.against && id !== strategy) ?? null);
  return {
    kind,
    /** The kind that suits the sweep. */
    defaultKind,
    /** The fields that it can be over. */
    axes,
    x,
    /** A map's other field. */
    other: axes.find((axis) => axis !== x) ?? null,
    y,
    /** The metric across in a trade-off. */
    versus: find(view.versus) ?? find(TRADED) ?? y,
    strategy,
    against,
    threshold: view.threshold === NONE ? null : (view.threshold ?? (against === null ? null : 0)),
    mapUnit: against === null ? y.unit : "%",
  };
}

/** The marker of each strategy there is. */
export function useMarkers() {
  const strategies = useStrategies();
  return useMemo(() => markersOf(strategies), [strategies]);
}

/** What a sweep's page gives its plot and its rows. */
export interface SweepParts {
  readonly batch: Batch;
  readonly columns: Columns;
  /** The batch's, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly shown: ShownPlot;
  readonly view: BatchView;
  /** The row with the lowest value of the plotted metric. */
  readonly best: number | null;
  readonly onView: (change: Partial<BatchView>) => void;
  readonly onOpen: (row: number) => void;
}

/** What the points and the map share. */
export interface PlotParts extends Pick<SweepParts, "batch" | "columns" | "strategies" | "shown" | "onOpen"> {
  readonly height: number;
  /** What a row says of itself, line by line. */
  readonly textOf: (row: number) => readonly string[];
}

const columnOf = (event: string) => `events.${event}`;

/** Asked for with every table, whatever is shown. */
export const CAVEAT_COLUMNS = CAVEAT_EVENTS.map(columnOf);

export function caveatsOfRow(columns: Columns, row: number, catalogue: Catalogue): readonly Caveat[] {
  const events = CAVEAT_EVENTS.map((event) => {
    const value = cell(columns, columnOf(event), row);
    return [event, typeof value === "number" || typeof value === "boolean" ? value : null] as const;
  });
  return caveatsOf(Object.fromEntries(events), catalogue);
}

export function isAirborne(columns: Columns, row: number): boolean {
  const value = cell(columns, columnOf("airborne_ms"), row);
  return typeof value === "number" && !isNothing(value);
}

/** `Height 0.05 m`, for every swept field. */
export const fieldTexts = (columns: Columns, row: number, fields: Batch["fields"]): readonly string[] =>
  fields.map(({ name, title, unit }) => `${title} ${showCell(cell(columns, name, row), unit)}`);

interface Context {
  readonly columns: Columns;
  readonly fields: Batch["fields"];
  readonly strategies: readonly Strategy[];
  readonly y: Metric;
  readonly catalogue: Catalogue;
}

/** The lines of what stands by a point under the pointer. */
export function describeRow(row: number, { columns, fields, strategies, y, catalogue }: Context): readonly string[] {
  const value = formatResult(Number(cell(columns, y.key, row)) * y.scale, 4);
  return [
    strategies.find(({ id }) => id === cell(columns, "strategy", row))?.label ?? "",
    ...fieldTexts(columns, row, fields),
    `${fullName(y)}: ${value} ${prettyUnit(y.unit)}`.trim(),
    ...(cell(columns, REQUIRED, row) === "fail" ? ["✕ A requirement fails"] : []),
    ...caveatsOfRow(columns, row, catalogue).map(({ text }) => `⚠ ${text}`),
  ];
}
