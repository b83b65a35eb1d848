/** A figure over a swept field: a point for each run, in its strategy's colour. */

import { Text, useComputedColorScheme } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import { useEffect, useEffectEvent, useMemo, useRef, useState } from "react";
import { isFinal } from "../api/follow";
import type { Batch, Strategy } from "../api/types";
import { PALETTES } from "../plots/palettes";
import type { PlotElement } from "../plots/plotly";
import { usePlotly } from "../plots/usePlotly";
import { formatWithUnit } from "../units/format";
import classes from "./batch.module.css";
import { DotLayer } from "./DotLayer";
import { fullName, type Figure } from "./figures";
import { PlotTools } from "./PlotTools";
import { scatterFigure } from "./scatter";
import { cell, pointsOf, type Columns } from "./table";
import { showCell } from "./show";
import type { BatchView } from "./view";

interface Props {
  readonly batch: Batch;
  readonly columns: Columns;
  readonly strategies: readonly Strategy[];
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

export function BatchPlot({ batch, columns, strategies, figures, x, y, view, best, onView, onOpen }: Props) {
  const plotly = usePlotly();
  const palette = PALETTES[useComputedColorScheme("light")];
  const { ref, width } = useElementSize<HTMLDivElement>();
  const host = useRef<HTMLDivElement>(null);

  const visible = useMemo(() => strategies.filter(({ id }) => !view.hidden.includes(id)), [strategies, view.hidden]);
  const figure = useMemo(() => {
    const points = pointsOf(columns, visible.map(({ id }) => id), x.name, y.key, y.scale);
    return scatterFigure({ points, strategies, x, y, best, joined: batch.fields.length === 1, palette });
  }, [columns, strategies, visible, x, y, best, batch.fields.length, palette]);

  const [drawing, setDrawing] = useState(0);
  useEffect(() => {
    if (!plotly || !host.current || width === 0) return undefined;
    let wanted = true;
    void plotly.react(host.current, figure.data, { ...figure.layout, width, height: HEIGHT }, CONFIG).then(() => {
      if (wanted) setDrawing((before) => before + 1);
    });
    return () => {
      wanted = false;
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
    return () => element.removeAllListeners("plotly_click");
  }, [plotly, width]);
  useEffect(() => {
    const element = host.current;
    return () => {
      if (plotly && element) plotly.purge(element);
    };
  }, [plotly]);

  const drawn = figure.count;
  return (
    <section className={classes.card} aria-label="Plot">
      <PlotTools {...{ batch, strategies, figures, x, y, view, onView }} />
      <div ref={ref} className={classes.plot} style={{ height: HEIGHT }}>
        <div ref={host} data-empty={drawn === 0 || undefined} role="img" aria-label={`${fullName(y)} over ${x.title}, ${drawn} runs. Every value stands in the table below.`} data-points={drawn} />
        <DotLayer {...{ host, drawing, width, onOpen }} dots={figure.dots} height={HEIGHT} units={[x.unit, y.unit]} />
        {drawn === 0 && <Text className={classes.plotEmpty}>{emptyReason(batch, visible.length)}</Text>}
      </div>
      <Text size="xs" className={classes.best}>
        {best === null ? "\u00a0" : describeBest(best, { batch, columns, strategies, y })}
      </Text>
    </section>
  );
}

function emptyReason(batch: Batch, strategies: number): string {
  if (strategies === 0) return "No strategy is switched on.";
  if (!isFinal(batch)) return batch.done > 0 ? "The first runs have finished and are on their way." : "No run has finished yet.";
  return "No run of the strategies shown has this figure.";
}

function describeBest(row: number, { batch, columns, strategies, y }: Pick<Props, "batch" | "columns" | "strategies" | "y">): string {
  const strategy = strategies.find(({ id }) => id === cell(columns, "strategy", row))?.label ?? "";
  const place = batch.fields.map((field) => `${field.title} ${showCell(cell(columns, field.name, row), field.unit)}`).join(", ");
  const value = Number(cell(columns, y.key, row)) * y.scale;
  return `○ Lowest: ${formatWithUnit(value, y.unit)}, ${strategy} at ${place} (run ${Number(cell(columns, "run", row))}). A click on a point opens its run; drag to zoom, double click for all.`;
}
