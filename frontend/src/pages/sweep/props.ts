/** What a sweep's page gives its plot and its rows. */

import type { Batch, Catalogue, Strategy } from "../../api/types";
import type { Markers } from "../../plots/markers";
import type { Figure } from "../../server/metrics";
import type { ShownPlot } from "./shownPlot";
import type { Columns } from "../../features/sweep/table";
import type { BatchView } from "./view";

export interface SweepParts {
  readonly batch: Batch;
  readonly columns: Columns;
  readonly catalogue: Catalogue;
  /** The batch's, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly markers: Markers;
  readonly figures: readonly Figure[];
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
