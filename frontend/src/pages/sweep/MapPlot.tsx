/** A metric over two swept fields in colours, and how much of it keeps a threshold. */

import { Group, Text, useComputedColorScheme } from "@mantine/core";
import { useMemo, useRef, useState } from "react";
import { Chart } from "../../plots/Chart";
import { ChartButton } from "../../plots/FigureButton";
import { ON_PAPER, PALETTES } from "../../plots/palettes";
import { count, formatExact, formatResult, titleWithUnit } from "../../units/format";
import { fullName } from "../../server/metrics";
import { oneRoadNoiseOf } from "../../features/tables/entries";
import { metricPath } from "../../lab/metricPath";
import { fieldTexts } from "./describeRow";
import { failing, firstOf, hatched, mapGrid, shareBelow, unsettled } from "./map";
import { mapFigure } from "./mapFigure";
import type { PlotParts } from "./shownPlot";

export function MapPlot({ batch, columns: newest, shown, strategies, height, textOf, onOpen }: PlotParts) {
  const scheme = useComputedColorScheme("light");
  const { x, other, y, strategy, against, threshold, mapUnit } = shown;
  const [pointed, setPointed] = useState(false);
  const columns = useHeld(newest, y.key, pointed);
  const labelOf = (id: string | null) => strategies.find((each) => each.id === id)?.label ?? "";
  const otherLabel = labelOf(against);
  const pair = strategies.filter(({ id }) => id === strategy || id === against);
  const noise = against === null ? 0 : oneRoadNoiseOf(pair, metricPath(y.key));
  const grid = useMemo(
    () => other && mapGrid(columns, { x: x.name, y: other.name, metric: y.key, scale: y.scale, strategy, against }),
    [columns, x, other, y, strategy, against],
  );
  const fails = useMemo(() => (grid ? failing(grid, columns) : []), [grid, columns]);
  const figure = useMemo(() => {
    if (!grid || !other) return null;
    const cellText = (row: number, value: number) => [
      ...textOf(row),
      ...(against === null ? [] : [`${formatResult(value)} % against ${otherLabel}`]),
    ];
    const title = fullName(y);
    const input = {
      grid,
      hatched: hatched(grid, columns),
      failing: fails,
      pale: unsettled(grid, noise),
      x,
      y: other,
      title,
      unit: mapUnit,
      difference: against !== null,
      threshold,
      textOf: cellText,
    };
    return {
      drawn: mapFigure({ ...input, palette: PALETTES[scheme], scheme }),
      onPaper: () => mapFigure({ ...input, palette: ON_PAPER, scheme: "light" }),
    };
  }, [grid, columns, fails, noise, x, other, y, mapUnit, against, otherLabel, threshold, textOf, scheme]);
  const host = useRef<HTMLDivElement>(null);

  if (!grid || !other || !figure)
    return (
      <Text p="3rem 1rem" fz="md" ta="center" c="dimmed">
        {columns.run ? "A map needs finished runs at two or more values of both fields." : "Loading the rows…"}
      </Text>
    );
  const name = `${fullName(y)}${against === null ? "" : `, change against ${otherLabel}`}, ${labelOf(strategy)}`;
  const { computed, gaps, below } = shareBelow(grid, threshold ?? Infinity);
  const limit = formatExact(threshold ?? 0, mapUnit);
  const points = count(computed, "point");
  const sentence =
    threshold === null
      ? `${points} with a value.`
      : against !== null && threshold === 0
        ? `${labelOf(strategy)} is at or below ${otherLabel} at ${below} of ${points}.`
        : `At or below ${limit} at ${below} of ${points}.`;
  const { drawn, onPaper } = figure;
  const first = firstOf(grid, fails);
  const colours = titleWithUnit(name, mapUnit);
  return (
    <>
      <div onPointerEnter={() => setPointed(true)} onPointerLeave={() => setPointed(false)}>
        <Chart
          hostRef={host}
          figure={drawn}
          height={height}
          label={`${name} over ${x.title} and ${other.title}. ${sentence} Every value stands in the table below.`}
          onPoint={onOpen}
        />
      </div>
      <Group gap="0" align="flex-start" justify="space-between" wrap="nowrap" pr="0.7rem">
        <Text size="xs" p="0.2rem 0.9rem 0.6rem" c="dimmed" data-testid="map-note">
          {colours}. {sentence}
          {hatched(grid, columns).flat().includes(true) && " Strokes: a tyre was in the air."}
          {first !== null &&
            ` Crosses: a requirement fails, first at ${fieldTexts(columns, first, batch.fields).join(", ")}.`}
          {unsettled(grid, noise).flat().includes(true) && " Pale: within one road’s luck."}
          {gaps > 0 && ` ${count(gaps, "gap")} without a value.`} A click on a cell opens its run; drag to zoom, double
          click for all.
        </Text>
        <ChartButton
          title={name}
          file={`ridelab-${batch.id}-${y.key}-${strategy}`}
          hostRef={host}
          draw={() => ({ figure: onPaper(), legend: [], colours })}
        />
      </Group>
    </>
  );
}

/** The newest value, or while `hold` the one before, unless another `key` is asked for. */
function useHeld<Value>(newest: Value, key: string, hold: boolean): Value {
  const [held, setHeld] = useState({ value: newest, key });
  const stays = hold && held.key === key;
  if (!stays && (held.value !== newest || held.key !== key)) setHeld({ value: newest, key });
  return stays ? held.value : newest;
}
