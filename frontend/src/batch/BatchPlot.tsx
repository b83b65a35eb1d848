/** The plot of a sweep: curves over a field, a map over two, or one metric against another. */

import { useCallback, useMemo } from "react";
import type { Batch, Catalogue, Strategy } from "../api/types";
import type { Markers } from "../plots/markers";
import { Card } from "../ui/Card";
import { axesOf } from "./axes";
import { describeRow } from "./describeRow";
import type { Figure } from "./figures";
import { MapPlot } from "./MapPlot";
import { PlotTools } from "./PlotTools";
import { PointsPlot } from "./PointsPlot";
import type { ShownPlot } from "./shownPlot";
import type { Columns } from "./table";
import type { BatchView } from "./view";

interface Props {
  readonly batch: Batch;
  readonly columns: Columns;
  readonly catalogue: Catalogue;
  readonly strategies: readonly Strategy[];
  readonly markers: Markers;
  readonly figures: readonly Figure[];
  readonly shown: ShownPlot;
  readonly view: BatchView;
  readonly best: number | null;
  readonly onView: (change: Partial<BatchView>) => void;
  readonly onOpen: (row: number) => void;
}

const HEIGHT = 400;

export function BatchPlot({ batch, columns, catalogue, strategies, markers, figures, shown, view, best, onView, onOpen }: Props) {
  const visible = useMemo(() => strategies.filter(({ id }) => !view.hidden.includes(id)), [strategies, view.hidden]);
  const { fields } = batch;
  const { y } = shown;
  const textOf = useCallback((row: number) => describeRow(row, { columns, fields, strategies, y, catalogue }), [columns, fields, strategies, y, catalogue]);
  const common = { columns, strategies, shown, textOf, onOpen, height: HEIGHT };
  return (
    <Card aria-label="Plot">
      <PlotTools axes={axesOf(fields)} {...{ strategies, markers, figures, shown, view, onView }} />
      {shown.kind === "map" ? <MapPlot {...common} batch={batch.id} /> : <PointsPlot key={shown.kind} {...common} {...{ batch, catalogue, visible, markers, best }} />}
    </Card>
  );
}
