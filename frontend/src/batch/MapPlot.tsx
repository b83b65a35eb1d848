/** A metric over two swept fields in colours, and how much of it keeps a threshold. */

import { Text, useComputedColorScheme } from "@mantine/core";
import { useMemo } from "react";
import type { Strategy } from "../api/types";
import { Chart } from "../plots/Chart";
import { PALETTES } from "../plots/palettes";
import { count, formatExact, formatResult, prettyUnit } from "../units/format";
import classes from "./batch.module.css";
import { fullName } from "./figures";
import { mapGrid, shareBelow } from "./map";
import { mapFigure } from "./mapFigure";
import type { ShownPlot } from "./shownPlot";
import type { Columns } from "./table";

interface Props {
  readonly columns: Columns;
  readonly shown: ShownPlot;
  readonly strategies: readonly Strategy[];
  readonly height: number;
  readonly textOf: (row: number) => readonly string[];
  readonly onOpen: (row: number) => void;
}

export function MapPlot({ columns, shown, strategies, height, textOf, onOpen }: Props) {
  const scheme = useComputedColorScheme("light");
  const { x, other, y, strategy, against, threshold, mapUnit } = shown;
  const labelOf = (id: string | null) => strategies.find((each) => each.id === id)?.label ?? "";
  const otherLabel = labelOf(against);
  const grid = useMemo(
    () => other && mapGrid(columns, { x: x.name, y: other.name, metric: y.key, scale: y.scale, strategy, against }),
    [columns, x, other, y, strategy, against],
  );
  const figure = useMemo(() => {
    if (!grid || !other) return null;
    const cellText = (row: number, value: number) => [
      ...textOf(row),
      ...(against === null ? [] : [`${formatResult(value)} % against ${otherLabel}`]),
    ];
    const title = fullName(y);
    return mapFigure({ grid, x, y: other, title, unit: mapUnit, difference: against !== null, threshold, textOf: cellText, palette: PALETTES[scheme], scheme });
  }, [grid, x, other, y, mapUnit, against, otherLabel, threshold, textOf, scheme]);

  if (!grid || !other) return <Text className={classes.noMap}>A map needs finished runs at two or more values of both fields.</Text>;
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
  return (
    <>
      <Chart figure={figure} height={height} label={`${name} over ${x.title} and ${other.title}. ${sentence} Every value stands in the table below.`} onPoint={onOpen} />
      <Text size="xs" className={classes.best} data-testid="map-note">
        {name}
        {prettyUnit(mapUnit) === "" ? "" : ` [${prettyUnit(mapUnit)}]`}. {sentence}
        {gaps > 0 && ` ${count(gaps, "gap")} without a value.`} A click on a cell opens its run; drag to zoom, double click for all.
      </Text>
    </>
  );
}
