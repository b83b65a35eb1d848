/** The plot of a sweep: curves over a field, a map over two, or one metric against another. */

import { useCallback, useMemo } from "react";
import { Card } from "../../ui/Card";
import { axesOf } from "../../features/sweep/axes";
import { describeRow } from "./describeRow";
import { MapPlot } from "./MapPlot";
import { PlotTools } from "./PlotTools";
import { PointsPlot } from "./PointsPlot";
import type { SweepParts } from "./props";

const HEIGHT = 400;

export function BatchPlot({
  batch,
  columns,
  catalogue,
  strategies,
  markers,
  figures,
  shown,
  view,
  best,
  onView,
  onOpen,
}: SweepParts) {
  const visible = useMemo(() => strategies.filter(({ id }) => !view.hidden.includes(id)), [strategies, view.hidden]);
  const { fields } = batch;
  const { y } = shown;
  const textOf = useCallback(
    (row: number) => describeRow(row, { columns, fields, strategies, y, catalogue }),
    [columns, fields, strategies, y, catalogue],
  );
  const common = { batch, columns, strategies, shown, textOf, onOpen, height: HEIGHT };
  return (
    <Card aria-label="Plot">
      <PlotTools axes={axesOf(fields)} {...{ strategies, markers, figures, shown, view, onView }} />
      {shown.kind === "map" ? (
        <MapPlot {...common} />
      ) : (
        <PointsPlot key={shown.kind} {...common} {...{ catalogue, visible, markers, best }} />
      )}
    </Card>
  );
}
