/** A figure over a swept field: a point for each run, in its strategy's colour. */

import { Text, useComputedColorScheme } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import { IconAlertTriangle } from "../icons";
import { useCallback, useEffect, useEffectEvent, useMemo, useRef, useState } from "react";
import { isFinal } from "../jobs/follow";
import type { Batch, Catalogue, Strategy } from "../api/types";
import type { Markers } from "../plots/markers";
import { PALETTES } from "../plots/palettes";
import type { PlotElement } from "../plots/plotly";
import { useCharts } from "../plots/usePlotly";
import { count, formatWhole, formatWithUnit } from "../units/format";
import classes from "./batch.module.css";
import { DotLayer } from "./DotLayer";
import { fullName, type Figure } from "./figures";
import { linesOf } from "./lines";
import { PlotTools } from "./PlotTools";
import { scatterFigure } from "./scatter";
import { cell, pointsOf, type Columns } from "./table";
import { describeRow, isAirborne, placeOf } from "./describeRow";
import type { BatchView } from "./view";
import { Card } from "../ui/Card";

interface Props {
  readonly batch: Batch;
  readonly columns: Columns;
  readonly catalogue: Catalogue;
  readonly strategies: readonly Strategy[];
  readonly markers: Markers;
  readonly figures: readonly Figure[];
  readonly x: Batch["fields"][number];
  readonly y: Figure;
  readonly view: BatchView;
  readonly best: number | null;
  readonly onView: (change: Partial<BatchView>) => void;
  readonly onOpen: (row: number) => void;
}

const HEIGHT = 380;
const CONFIG = { displayModeBar: false, responsive: false, doubleClick: "reset", showTips: false } as const;

export function BatchPlot({ batch, columns, catalogue, strategies, markers, figures, x, y, view, best, onView, onOpen }: Props) {
  const plotly = useCharts();
  const palette = PALETTES[useComputedColorScheme("light")];
  const { ref, width } = useElementSize<HTMLDivElement>();
  const host = useRef<HTMLDivElement>(null);

  const visible = useMemo(() => strategies.filter(({ id }) => !view.hidden.includes(id)), [strategies, view.hidden]);
  const { fields, sweep } = batch;
  const textOf = useCallback((row: number) => describeRow(row, { columns, fields, strategies, y, catalogue }), [columns, fields, strategies, y, catalogue]);
  const points = useMemo(() => pointsOf(columns, visible.map(({ id }) => id), x.name, y.key, y.scale), [columns, visible, x, y]);
  const curves = fields.length === 1;
  const joined = curves || Boolean(sweep.grid);
  const figure = useMemo(() => {
    const others = fields.map(({ name }) => name).filter((name) => name !== x.name);
    const lines = joined ? linesOf(columns, points, others) : [];
    const isHollow = (row: number) => isAirborne(columns, row);
    return scatterFigure({ points, strategies, markers, x, y, best, lines, curves, isHollow, textOf, palette });
  }, [points, columns, fields, joined, curves, strategies, markers, x, y, best, textOf, palette]);
  const airborne = useMemo(() => points.reduce((sum, { rows }) => sum + rows.filter((row) => isAirborne(columns, row)).length, 0), [points, columns]);

  const [drawing, setDrawing] = useState(0);
  useEffect(() => {
    if (!plotly || !host.current || width === 0) return undefined;
    let mounted = true;
    void plotly.react(host.current, [...figure.lines, ...figure.data], { ...figure.layout, width, height: HEIGHT }, CONFIG).then(() => {
      if (mounted) setDrawing((before) => before + 1);
    });
    return () => {
      mounted = false;
    };
  }, [plotly, figure, width]);

  const openRow = useEffectEvent((row: number) => onOpen(row));
  useEffect(() => {
    const element = host.current as PlotElement | null;
    if (!plotly || !element || width === 0) return undefined;
    element.on("plotly_click", ({ points }) => {
      const row = points[0]?.customdata;
      if (row !== undefined) openRow(row);
    });
    return () => element.removeAllListeners?.("plotly_click");
  }, [plotly, width]);
  useEffect(() => {
    const element = host.current;
    return () => {
      if (plotly && element) plotly.purge(element);
    };
  }, [plotly]);

  const drawn = figure.count;
  return (
    <Card aria-label="Plot">
      <PlotTools {...{ batch, strategies, markers, figures, x, y, view, onView }} />
      <div ref={ref} className={classes.plot} style={{ height: HEIGHT }}>
        <div ref={host} data-empty={drawn === 0 || undefined} role="img" aria-label={`${fullName(y)} over ${x.title}, ${drawn} runs. Every value stands in the table below.`} data-points={drawn} />
        <DotLayer {...{ host, drawing, width, onOpen }} dots={figure.dots} height={HEIGHT} textOf={textOf} />
        {drawn === 0 && <Text className={classes.plotEmpty}>{emptyReason(batch, visible.length, columns)}</Text>}
      </div>
      {airborne > 0 && (
        <Text size="xs" className={classes.warning} data-testid="airborne-note" title={catalogue.events.find(({ key }) => key === "airborne_ms")?.description}>
          <IconAlertTriangle size={13} stroke={2} aria-hidden /> {formatWhole(airborne)} of the {count(drawn, "run")} shown {airborne === 1 ? "is" : "are"} airborne
          (hollow points): their linear tyre pulls on the road, which a real one cannot.
        </Text>
      )}
      <Text size="xs" className={classes.best}>
        {best === null ? "\u00a0" : describeBest(best, { batch, columns, strategies, y })}
      </Text>
    </Card>
  );
}

function emptyReason(batch: Batch, strategies: number, columns: Columns): string {
  if (strategies === 0) return "No strategy is switched on.";
  if (!isFinal(batch) && batch.done === 0) return "No run has finished yet.";
  if (batch.done > 0 && !columns.status?.includes("ok")) return "Reading the runs that have finished …";
  if (!isFinal(batch)) return "No run of the strategies shown has finished with this figure yet.";
  return "No run of the strategies shown has this figure.";
}

function describeBest(row: number, { batch, columns, strategies, y }: Pick<Props, "batch" | "columns" | "strategies" | "y">): string {
  const strategy = strategies.find(({ id }) => id === cell(columns, "strategy", row))?.label ?? "";
  const place = placeOf(columns, row, batch.fields).join(", ");
  const value = Number(cell(columns, y.key, row)) * y.scale;
  return `○ Lowest: ${formatWithUnit(value, y.unit)}, ${strategy} at ${place} (run ${Number(cell(columns, "run", row))}). A click on a point opens its run; drag to zoom, double click for all.`;
}
