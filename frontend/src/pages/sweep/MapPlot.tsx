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
import {
  coarse,
  failing,
  firstFailure,
  hatched,
  lacksStops,
  mapGrid,
  shareBelow,
  type MapGrid,
  type AxisValue,
  type Marked,
} from "./map";
import { fieldTexts, type PlotParts } from "./view";
import { isFinal } from "../../jobs/useJob";
import { type Columns, type AxisOf } from "../../features/sweep/table";
import { chartLayout, pointTrace } from "../../plots/palettes";
import { type GridTrace, type PlotLayout, type PointTrace } from "../../plots/plotly";
import { humanise } from "../../scenario/schema";
import { isSpreadByRatio } from "./scatter";

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

/** How a map is drawn: its cells in colours, what is marked in them, and a line at the threshold. */
interface MapParts extends Pick<Look, "palette" | "scheme"> {
  readonly grid: MapGrid;
  readonly x: AxisOf;
  readonly y: AxisOf;
  /** What stands at the colours. */
  readonly title: string;
  readonly unit: string;
  readonly difference: boolean;
  readonly threshold: number | null;
  /** What a cell says of itself, line by line. */
  readonly textOf: (row: number, value: number, half: number) => readonly string[];
  /** Values of cells whose run is still to come, as those nearby suggest. */
  readonly coarse: readonly (readonly (number | null)[])[];
  /** Cells in which a tyre was in the air or a bump stop was hit. */
  readonly hatched: Marked;
  /** Cells in which a run fails a requirement. */
  readonly failing: Marked;
}

/** Less is better: blue is less than the other, orange is more; the middle is the page's ground. */
const DIVERGING = {
  light: [
    [0, "#0b4fc4"],
    [0.25, "#7ba7ef"],
    [0.5, "#f1f3f4"],
    [0.75, "#f0a35e"],
    [1, "#b34700"],
  ],
  dark: [
    [0, "#5b93ff"],
    [0.25, "#3a5f9e"],
    [0.5, "#24292c"],
    [0.75, "#96571e"],
    [1, "#ff8a2a"],
  ],
} as const;
/** Beyond this change [%] all is one colour. */
const MOST_CHANGE = 100;

const named = (value: AxisValue) => (typeof value === "string" ? humanise(value) : value);

function colours({ grid, difference, scheme }: MapParts) {
  const values = grid.values.flat().filter((value) => value !== null);
  const [least, greatest] = [Math.min(...values), Math.max(...values)];
  // Stated, so that what is faint has the same colours.
  if (!difference) return { colorscale: "Cividis", ...(least < greatest ? { zmin: least, zmax: greatest } : {}) };
  const most = Math.min(MOST_CHANGE, Math.max(1, -least, greatest));
  return { colorscale: DIVERGING[scheme], zmin: -most, zmax: most };
}

function line({ grid, threshold, unit }: MapParts): readonly GridTrace[] {
  if (
    threshold === null ||
    grid.xs.some((value) => typeof value === "string") ||
    grid.ys.some((value) => typeof value === "string")
  )
    return [];
  const common = {
    type: "contour",
    x: grid.xs,
    y: grid.ys,
    z: grid.values,
    showscale: false,
    hoverinfo: "skip",
    connectgaps: false,
    autocontour: false,
  } as const;
  const contours = { start: threshold, end: threshold, size: 1, coloring: "none" };
  // A light line below a dark one is seen on every colour.
  return [
    { ...common, name: "", contours, line: { width: 5, color: "#ffffff" } },
    { ...common, name: formatExact(threshold, unit), contours, line: { width: 2, color: "#101418" } },
  ];
}

const [USUAL_WIDTH, USUAL_HEIGHT] = [700, 340]; // of all cells together [px]

const GROUND = { light: "#ffffff", dark: "#1a1b1e" } as const;

const INK = { light: "#101418", dark: "#f1f3f4" } as const;

/** Over the cells: a veil where the change may be random, crosses where a requirement fails. */
function marks({ grid, failing, scheme }: MapParts): readonly (GridTrace | PointTrace)[] {
  const [xs, ys] = [grid.xs.map(named), grid.ys.map(named)];
  const veil: GridTrace = {
    type: "heatmap",
    name: "",
    x: xs,
    y: ys,
    z: grid.unsettled.map((line) => line.map((isPale) => (isPale ? 1 : null))),
    colorscale: [
      [0, GROUND[scheme]],
      [1, GROUND[scheme]],
    ],
    opacity: 0.65,
    showscale: false,
    hoverinfo: "skip",
    xgap: 1,
    ygap: 1,
  };
  // As large as most of a cell allows: where there are few, small ones are lost in them.
  const size = Math.max(14, Math.min(48, 0.6 * Math.min(USUAL_WIDTH / xs.length, USUAL_HEIGHT / ys.length)));
  const crossed = failing.flatMap((line, i) =>
    line.flatMap((isMarked, j) => (isMarked ? [[xs[j], ys[i]] as const] : [])),
  );
  const place = { x: crossed.map(([x]) => x ?? 0), y: crossed.map(([, y]) => y ?? 0) };
  const crosses = pointTrace("", { ...place, symbol: "x-thin-open", size, line: { width: 2.5 }, color: INK[scheme] });
  return [...(grid.unsettled.flat().includes(true) ? [veil] : []), ...(crossed.length > 0 ? [crosses] : [])];
}

/** From a share of the i-th cell to the axis: a cell ends midway to the next value, names stand one apart. */
function cellScale(values: readonly AxisValue[]): (index: number, share: number) => number {
  const isLog = isSpreadByRatio(values);
  const at = values.map((value, index) => (typeof value === "string" ? index : isLog ? Math.log(value) : value));
  const gap = (index: number) => (at[index + 1] ?? 0) - (at[index] ?? 0);
  return (index, share) => {
    const below = gap(Math.max(0, index - 1)) / 2;
    const above = gap(Math.min(index, at.length - 2)) / 2;
    const position = (at[index] ?? 0) - below + share * (below + above);
    return isLog ? Math.exp(position) : position;
  };
}

/** Of a cell, from its lower left corner. */
const STROKES = [
  [0, 0.5, 0.5, 1],
  [0, 0, 1, 1],
  [0.5, 0, 1, 0.5],
] as const;

/** Where a tyre was in the air or a stop was hit; the strokes of all cells are one shape. */
function hatch({ grid, hatched, scheme }: MapParts): PlotLayout["shapes"] {
  const [toX, toY] = [cellScale(grid.xs), cellScale(grid.ys)];
  const path = hatched.flatMap((line, i) =>
    line.flatMap((isMarked, j) =>
      isMarked ? STROKES.map(([x0, y0, x1, y1]) => `M ${toX(j, x0)},${toY(i, y0)} L ${toX(j, x1)},${toY(i, y1)}`) : [],
    ),
  );
  return path.length === 0
    ? []
    : [{ type: "path", path: path.join(" "), line: { color: INK[scheme], width: 1.2 }, opacity: 0.75 }];
}

export function mapFigure(input: MapParts): {
  readonly data: readonly (GridTrace | PointTrace)[];
  readonly layout: PlotLayout;
} {
  const { grid, x, y, title, unit, textOf, palette } = input;
  const axis = (field: AxisOf, values: readonly AxisValue[]) => ({
    title: { text: titleWithUnit(field.title, field.unit) },
    showgrid: false,
    ...(isSpreadByRatio(values)
      ? { type: "log", exponentformat: "power" }
      : values.some((value) => typeof value === "string")
        ? { type: "category" }
        : {}),
  });
  const cells: GridTrace = {
    type: "heatmap",
    name: title,
    x: grid.xs.map(named),
    y: grid.ys.map(named),
    z: grid.values,
    customdata: grid.rows.map((line) => line.map(([first = null]) => first)),
    text: grid.values.map((values, i) =>
      values.map((value, j) =>
        value === null ? "" : textOf(grid.rows[i]?.[j]?.[0] ?? 0, value, grid.halves[i]?.[j] ?? 0).join("<br>"),
      ),
    ),
    hovertemplate: "%{text}<extra></extra>",
    hoverongaps: false,
    xgap: 1,
    ygap: 1,
    ...colours(input),
    colorbar: {
      title: { text: unit === "%" ? "change [%]" : titleWithUnit("", unit).trim(), side: "right" },
      thickness: 14,
      outlinewidth: 0,
      tickcolor: palette.grid,
    },
  };
  const faint: GridTrace = { ...cells, z: input.coarse, opacity: 0.5, showscale: false, hoverinfo: "skip" };
  const isWhole = input.coarse.every((line) => line.every((value) => value === null));
  return {
    data: [cells, ...(isWhole ? [] : [faint]), ...marks(input), ...line(input)],
    layout: chartLayout(palette, {
      margin: { l: 56, r: 8, t: 8, b: 52 },
      uirevision: `${x.name} ${y.name}`,
      xaxis: axis(x, grid.xs),
      yaxis: axis(y, grid.ys),
      shapes: hatch(input),
    }),
  };
}
