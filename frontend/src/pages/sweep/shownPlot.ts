/** What a sweep's plot shows: the address's wishes where they can be met, and what suits the sweep elsewhere. */

import type { Batch, Strategy, StrategyId } from "../../api/types";
import { axesOf, type AxisOf, type Columns } from "../../features/sweep/table";
import { SEED } from "../../scenario/fields";
import { OPENING_METRIC, type Metric } from "../../server/metrics";
import { NONE, type BatchView, type PlotKind } from "./view";
import type { Markers } from "../../plots/markers";

export interface ShownPlot {
  readonly kind: PlotKind;
  /** Two fields are swept, over a grid, on one road or several. */
  readonly mappable: boolean;
  /** The fields that it can be over. */
  readonly axes: readonly AxisOf[];
  readonly x: AxisOf;
  /** A map's other field. */
  readonly other: AxisOf | null;
  readonly y: Metric;
  /** The metric across in a trade-off. */
  readonly versus: Metric;
  readonly strategy: StrategyId;
  readonly against: StrategyId | null;
  readonly threshold: number | null;
  readonly mapUnit: string;
}

const PASSIVE = "passive";
const TRADED = "travel_time";

export function shownPlot(
  batch: Pick<Batch, "fields" | "sweep">,
  strategies: readonly Strategy[],
  figures: readonly Metric[],
  view: BatchView,
): ShownPlot | null {
  const all = axesOf(batch.fields);
  const varied = all.filter(({ name }) => name !== SEED);
  const mappable = varied.length === 2 && !batch.sweep.latin_hypercube;
  const kind =
    view.plot === null ? (mappable ? "map" : "points") : view.plot === "map" && !mappable ? "points" : view.plot;
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
    mappable,
    axes,
    x,
    other: axes.find((axis) => axis !== x) ?? null,
    y,
    versus: find(view.versus) ?? find(TRADED) ?? y,
    strategy,
    against,
    threshold: view.threshold === NONE ? null : (view.threshold ?? (against === null ? null : 0)),
    mapUnit: against === null ? y.unit : "%",
  };
}

/** What a sweep's page gives its plot and its rows. */
export interface SweepParts {
  readonly batch: Batch;
  readonly columns: Columns;
  /** The batch's, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly markers: Markers;
  readonly figures: readonly Metric[];
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
