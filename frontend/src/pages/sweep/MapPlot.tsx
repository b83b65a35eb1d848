/** A metric over two swept fields in colours, and how much of it keeps a threshold. */

import { Group, Text } from "@mantine/core";
import { useMemo, useState } from "react";
import { Chart } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { count, formatExact, formatResult, prettyUnit, titleWithUnit } from "../../units/format";
import { fullName } from "../../server/metrics";
import { formatPercent } from "../../features/tables/change";
import { isRandom, oneRoadNoiseOf } from "../../features/tables/entries";
import { metricPath } from "../../lab/metricPath";
import { coarse, failing, firstFailure, hatched, lacksStops, mapGrid, shareBelow, type MapGrid } from "./map";
import { fieldTexts, type PlotParts } from "./view";
import { isFinal } from "../../jobs/useJob";
import type { Columns } from "../../features/sweep/table";
import { mapFigure } from "./mapFigure";

export function MapPlot({ batch, columns: newest, shown, strategies, height, textOf, onOpen }: PlotParts) {
  const { x, other, y, strategy, against, threshold, mapUnit } = shown;
  const [pointed, setPointed] = useState(false);
  const columns = useHeld(newest, y.key, pointed && !isFinal(batch));
  const labelOf = (id: string | null) => strategies.find((each) => each.id === id)?.label ?? "";
  const otherLabel = labelOf(against);
  const pair = strategies.filter(({ id }) => id === strategy || id === against);
  const varied = batch.fields.map(({ name }) => name);
  const oneRoadNoise = oneRoadNoiseOf(pair, metricPath(y.key), isRandom(batch.scenario, varied));
  const grid = useMemo(() => {
    const { key: metric, scale } = y;
    return other && mapGrid(columns, { x: x.name, y: other.name, metric, scale, strategy, against, oneRoadNoise });
  }, [columns, x, other, y, strategy, against, oneRoadNoise]);
  const name = `${fullName(y)}${against === null ? "" : `, change against ${otherLabel}`}, ${labelOf(strategy)}`;
  const colours = titleWithUnit(name, mapUnit);
  const draw = useMemo(() => {
    if (!grid || !other) return null;
    const ofMean = mostRoads(grid) > 1;
    const input = {
      grid,
      hatched: hatched(grid, columns),
      failing: failing(grid, columns),
      x,
      y: other,
      title: fullName(y),
      unit: mapUnit,
      difference: against !== null,
      threshold,
      textOf: (row: number, value: number, half: number) => [
        ...textOf(row),
        ...(against !== null
          ? [`${ofMean ? "Mean of the roads: " : ""}${formatPercent(value, half)} against ${otherLabel}`]
          : ofMean
            ? [`Mean of the roads: ${formatResult(value)} ${prettyUnit(mapUnit)}`]
            : []),
      ],
    };
    return ({ palette, scheme, onPaper }: Look) => ({
      figure: mapFigure({
        ...input,
        palette,
        scheme,
        coarse: onPaper || isFinal(batch) ? [] : coarse(grid, columns),
      }),
      legend: [],
      colours,
    });
  }, [grid, batch, columns, x, other, y, mapUnit, against, otherLabel, threshold, textOf, colours]);
  const { chart, button } = useChart({ title: name, file: `ridelab-${batch.id}-${y.key}-${strategy}`, draw });

  if (!grid || !other)
    return (
      <Text p="3rem 1rem" fz="md" ta="center" c="dimmed">
        {columns.run ? "A map needs finished runs at two or more values of both fields." : "Loading the rows…"}
      </Text>
    );
  const { computed, gaps, below } = shareBelow(grid, threshold ?? Infinity);
  const limit = formatExact(threshold ?? 0, mapUnit);
  const points = count(computed, "point");
  const sentence =
    threshold === null
      ? `${points} with a value.`
      : against !== null && threshold === 0
        ? `${labelOf(strategy)} is at or below ${otherLabel} at ${below} of ${points}.`
        : `At or below ${limit} at ${below} of ${points}.`;
  const first = firstFailure(grid, columns);
  const roads = mostRoads(grid);
  return (
    <>
      <div onPointerEnter={() => setPointed(true)} onPointerLeave={() => setPointed(false)}>
        <Chart
          {...chart}
          height={height}
          label={`${name} over ${x.title} and ${other.title}. ${sentence} Every value stands in the table below.`}
          onPoint={onOpen}
        />
      </div>
      <Group gap="0" align="flex-start" justify="space-between" wrap="nowrap" pr="0.7rem">
        <Text size="xs" p="0.2rem 0.9rem 0.6rem" c="dimmed" data-testid="map-note">
          {colours}
          {roads > 1 && `, mean of ${roads} roads`}. {sentence}
          {hatched(grid, columns).flat().includes(true) && " Strokes: a tyre was in the air or a bump stop was hit."}
          {lacksStops(columns) && " These runs were stored before bump stops were recorded: strokes show tyres alone."}
          {first !== null &&
            ` Crosses: a requirement fails, first at ${fieldTexts(columns, first, batch.fields).join(", ")}.`}
          {grid.unsettled.flat().includes(true) &&
            (roads > 1
              ? " Pale: the 95 % interval over the roads contains zero."
              : " Pale: not beyond the random variation of one road.")}
          {isFinal(batch) ? gaps > 0 && ` ${count(gaps, "gap")} without a value.` : " Faint: as the nearest point."} A
          click on a cell opens its {roads > 1 && "first "}run; drag to zoom, double click for all.
        </Text>
        {button}
      </Group>
    </>
  );
}

/** Over how many roads it is. */
const mostRoads = ({ rows }: MapGrid) => Math.max(...rows.flat().map(({ length }) => length));

/** The newest values, or while `hold` those before, unless there are none or another column is asked for. */
function useHeld(newest: Columns, key: string, hold: boolean): Columns {
  const [held, setHeld] = useState({ value: newest, key });
  const stays = hold && held.key === key && held.value[key]?.some((value) => value !== null) === true;
  if (!stays && (held.value !== newest || held.key !== key)) setHeld({ value: newest, key });
  return stays ? held.value : newest;
}
