/** Runs as points in their strategy's colour: a metric over a swept field, or over another metric. */

import { Group, Text } from "@mantine/core";
import { useCallback, useMemo, useState } from "react";
import type { Batch, Strategy } from "../../api/types";
import { Icon } from "../../ui/icons";
import { isFinal } from "../../jobs/useJob";
import { Chart } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { useCatalogue } from "../../server/useCatalogues";
import { count, formatWhole, formatWithUnit } from "../../units/format";
import { axesOf, type AxisOf, cell, pointsOf, type Columns, showCell } from "../../features/sweep/table";
import classes from "./sweep.module.css";
import { isAirborne, fieldTexts, type ShownPlot, type PlotParts, type SweepParts, useMarkers } from "./view";
import { DotLayer } from "./DotLayer";
import { fullName } from "../../server/metrics";
import { frontOf, linesOf, scatterFigure } from "./scatter";
import ui from "../../ui/ui.module.css";

interface Props extends PlotParts, Pick<SweepParts, "best"> {
  /** Those switched on. */
  readonly visible: readonly Strategy[];
}

const NONE: readonly number[] = [];
const CENTRED = { placeItems: "center", pointerEvents: "none" } as const;

export function PointsPlot({ batch, columns, strategies, visible, shown, best, height, textOf, onOpen }: Props) {
  const catalogue = useCatalogue();
  const markers = useMarkers();
  const [ownPoints, setOwnPoints] = useState(false);
  const onNoAxes = useCallback(() => setOwnPoints(true), []);

  const { y, versus } = shown;
  const tradeOff = shown.kind === "trade_off";
  const x: AxisOf = useMemo(
    () => (tradeOff ? { name: versus.key, title: fullName(versus), unit: versus.unit } : shown.x),
    [tradeOff, versus, shown.x],
  );
  const xScale = tradeOff ? versus.scale : 1;
  const { fields, sweep } = batch;
  const points = useMemo(() => {
    const ids = visible.map(({ id }) => id);
    return pointsOf(columns, ids, x.name, y.key, y.scale, xScale);
  }, [columns, visible, x, y, xScale]);
  const front = useMemo(() => (tradeOff ? frontOf(points).map(({ row }) => row) : NONE), [tradeOff, points]);
  const axes = useMemo(() => axesOf(fields), [fields]);
  const curves = axes.length === 1;
  const joined = !tradeOff && (curves || Boolean(sweep.grid));
  const draw = useMemo(() => {
    const others = axes.filter(({ name }) => name !== x.name);
    const names = others.map(({ name }) => name);
    const lines = joined ? linesOf(columns, points, names) : [];
    const labelOf = (row: number) =>
      others.map(({ name, unit }) => showCell(cell(columns, name, row), unit)).join(", ");
    const isHollow = (row: number) => isAirborne(columns, row);
    const ringed = tradeOff ? front : best === null ? NONE : [best];
    const input = { points, markers, x, y, ringed, front: tradeOff, lines, curves, labelOf, isHollow, textOf };
    return ({ strategies: coloured, palette, onPaper }: Look) => ({
      figure: scatterFigure({
        ...input,
        palette,
        strategies: coloured,
        ...((onPaper || ownPoints) && { most: Infinity }),
      }),
      legend: strategies.map(({ label }) => label),
    });
  }, [points, columns, axes, joined, curves, markers, x, y, best, tradeOff, front, textOf, ownPoints, strategies]);
  const { drawn, chart, button } = useChart({ title: fullName(y), file: `ridelab-${batch.id}-${y.key}`, draw });
  const airborne = useMemo(
    () => points.reduce((sum, { rows }) => sum + rows.filter((row) => isAirborne(columns, row)).length, 0),
    [points, columns],
  );

  const { count: runs = 0, dots = [] } = drawn?.figure ?? {};
  return (
    <>
      <div className={classes.plot}>
        <Chart
          {...chart}
          height={height}
          points={runs}
          label={`${fullName(y)} over ${x.title}, ${runs} runs. Every value stands in the table below.`}
          onPoint={onOpen}
          over={(drawing, width) => (
            <DotLayer {...{ drawing, dots, width, height, onOpen, onNoAxes, textOf }} host={chart.hostRef} />
          )}
        />
        {runs === 0 && (
          <Text pos="absolute" inset={0} display="grid" p="1rem" fz="md" ta="center" c="dimmed" style={CENTRED}>
            {emptyReason(batch, visible.length, columns)}
          </Text>
        )}
      </div>
      {airborne > 0 && (
        <Text
          size="xs"
          className={ui.warning ?? ""}
          p="0.2rem 0.9rem 0"
          data-testid="airborne-note"
          title={catalogue.events.find(({ key }) => key === "airborne_ms")?.description}
        >
          <Icon name="AlertTriangle" size={13} className={ui.inline} /> {formatWhole(airborne)} of the{" "}
          {count(runs, "run")} shown {airborne === 1 ? "is" : "are"} airborne (hollow points): their linear tyre pulls
          on the road, which a real one cannot.
        </Text>
      )}
      <Group gap="0" align="flex-start" justify="space-between" wrap="nowrap" pr="0.7rem">
        <Text size="xs" p="0.2rem 0.9rem 0.6rem" c="dimmed">
          {tradeOff
            ? describeFront(front, columns, visible)
            : best === null
              ? "\u00a0"
              : describeBest(best, { batch, columns, strategies, y })}
        </Text>
        {runs > 0 && button}
      </Group>
    </>
  );
}

function emptyReason(batch: Batch, strategies: number, columns: Columns): string {
  if (strategies === 0) return "No strategy is switched on.";
  if (!isFinal(batch) && batch.done === 0) return "No run has finished yet.";
  if (batch.done > 0 && !columns.status?.includes("ok")) return "Loading the runs that have finished…";
  if (!isFinal(batch)) return "No run of the strategies shown has finished with this metric yet.";
  return "No run of the strategies shown has this metric.";
}

function describeBest(
  row: number,
  { batch, columns, strategies, y }: Pick<Props, "batch" | "columns" | "strategies"> & Pick<ShownPlot, "y">,
): string {
  const strategy = strategies.find(({ id }) => id === cell(columns, "strategy", row))?.label ?? "";
  const values = fieldTexts(columns, row, batch.fields).join(", ");
  const value = Number(cell(columns, y.key, row)) * y.scale;
  return `○ Lowest: ${formatWithUnit(value, y.unit)}, ${strategy} at ${values} (run ${Number(cell(columns, "run", row))}). A click on a point opens its run; drag to zoom, double click for all.`;
}

function describeFront(front: readonly number[], columns: Columns, visible: readonly Strategy[]): string {
  const parts = visible.flatMap(({ id, label }) => {
    const own = front.filter((row) => cell(columns, "strategy", row) === id).length;
    return own === 0 ? [] : [`${label} ${formatWhole(own)}`];
  });
  return `○ Pareto front: ${count(front.length, "run")} that no other betters in both metrics (${parts.join(", ")}). Less is better in both. A click on a point opens its run.`;
}
