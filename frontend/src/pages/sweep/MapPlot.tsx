/** A metric over two swept fields in colours, and how much of it keeps a threshold. */

import { Group, Text, useComputedColorScheme } from "@mantine/core";
import { useMemo, useRef, useState } from "react";
import { Chart } from "../../plots/Chart";
import { ChartButton } from "../../plots/FigureButton";
import { ON_PAPER, PALETTES, chartLayout, type Palette } from "../../plots/palettes";
import { count, formatExact, formatResult, titleWithUnit } from "../../units/format";
import { fullName } from "../../server/metrics";
import { isRandom, oneRoadNoiseOf } from "../../features/tables/entries";
import { metricPath } from "../../lab/metricPath";
import { fieldTexts } from "./describeRow";
import { coarse, failing, firstOf, hatched, mapGrid, shareBelow, unsettled, type MapGrid, type AxisValue } from "./map";
import type { PlotParts } from "./shownPlot";
import { humanise } from "../../scenario/schema";
import type { GridTrace, PlotLayout, PointTrace } from "../../plots/plotly";
import { isFinal } from "../../jobs/follow";
import type { AxisOf, Columns } from "../../features/sweep/table";
import { isSpreadByRatio } from "./scatter";

export function MapPlot({ batch, columns: newest, shown, strategies, height, textOf, onOpen }: PlotParts) {
  const scheme = useComputedColorScheme("light");
  const { x, other, y, strategy, against, threshold, mapUnit } = shown;
  const [pointed, setPointed] = useState(false);
  const columns = useHeld(newest, y.key, pointed && !isFinal(batch));
  const labelOf = (id: string | null) => strategies.find((each) => each.id === id)?.label ?? "";
  const otherLabel = labelOf(against);
  const pair = strategies.filter(({ id }) => id === strategy || id === against);
  const varied = batch.fields.map(({ name }) => name);
  const noise = against === null ? 0 : oneRoadNoiseOf(pair, metricPath(y.key), isRandom(batch.scenario, varied));
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
      coarse: isFinal(batch) ? [] : coarse(grid, columns),
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
      onPaper: () => mapFigure({ ...input, coarse: [], palette: ON_PAPER, scheme: "light" }),
    };
  }, [grid, batch, columns, fails, noise, x, other, y, mapUnit, against, otherLabel, threshold, textOf, scheme]);
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
          {hatched(grid, columns).flat().includes(true) && " Strokes: a tyre was in the air or a bump stop was hit."}
          {first !== null &&
            ` Crosses: a requirement fails, first at ${fieldTexts(columns, first, batch.fields).join(", ")}.`}
          {unsettled(grid, noise).flat().includes(true) && " Pale: within one road’s luck."}
          {isFinal(batch) ? gaps > 0 && ` ${count(gaps, "gap")} without a value.` : " Faint: as the nearest point."} A
          click on a cell opens its run; drag to zoom, double click for all.
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

/** The newest values, or while `hold` those before, unless there are none or another column is asked for. */
function useHeld(newest: Columns, key: string, hold: boolean): Columns {
  const [held, setHeld] = useState({ value: newest, key });
  const stays = hold && held.key === key && held.value[key]?.some((value) => value !== null) === true;
  if (!stays && (held.value !== newest || held.key !== key)) setHeld({ value: newest, key });
  return stays ? held.value : newest;
}

interface Input {
  readonly grid: MapGrid;
  readonly x: AxisOf;
  readonly y: AxisOf;
  /** What stands at the colours. */
  readonly title: string;
  readonly unit: string;
  readonly difference: boolean;
  readonly threshold: number | null;
  /** What a cell says of itself, line by line. */
  readonly textOf: (row: number, value: number) => readonly string[];
  /** Values of cells whose run is still to come, as those nearby suggest. */
  readonly coarse: readonly (readonly (number | null)[])[];
  /** Cells in which a tyre was in the air or a bump stop was hit. */
  readonly hatched: readonly (readonly boolean[])[];
  /** Cells whose run fails a requirement. */
  readonly failing: readonly (readonly boolean[])[];
  /** Cells whose change may be luck. */
  readonly pale: readonly (readonly boolean[])[];
  readonly palette: Palette;
  readonly scheme: "light" | "dark";
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

function colours({ grid, difference, scheme }: Input) {
  const values = grid.values.flat().filter((value) => value !== null);
  const [least, greatest] = [Math.min(...values), Math.max(...values)];
  // Stated, so that what is faint has the same colours.
  if (!difference) return { colorscale: "Cividis", ...(least < greatest ? { zmin: least, zmax: greatest } : {}) };
  const most = Math.min(MOST_CHANGE, Math.max(1, -least, greatest));
  return { colorscale: DIVERGING[scheme], zmin: -most, zmax: most };
}

function line({ grid, threshold, unit }: Input): readonly GridTrace[] {
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

const GROUND = { light: "#ffffff", dark: "#1a1b1e" } as const;

/** Over the cells: a veil where the change may be luck, strokes where a tyre was in the air or a stop was hit, crosses where a requirement fails. */
function marks({ grid, hatched, failing, pale, scheme }: Input): readonly (GridTrace | PointTrace)[] {
  const [xs, ys] = [grid.xs.map(named), grid.ys.map(named)];
  const veil: GridTrace = {
    type: "heatmap",
    name: "",
    x: xs,
    y: ys,
    z: pale.map((line) => line.map((isPale) => (isPale ? 1 : null))),
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
  const signs = (marked: readonly (readonly boolean[])[], symbol: string): readonly PointTrace[] => {
    const cells = marked.flatMap((line, i) =>
      line.flatMap((isMarked, j) => (isMarked ? [[xs[j], ys[i]] as const] : [])),
    );
    const sign: PointTrace = {
      type: "scatter",
      mode: "markers",
      name: "",
      x: cells.map(([x]) => x ?? 0),
      y: cells.map(([, y]) => y ?? 0),
      marker: { symbol, size: 16, line: { width: 2.5 }, color: scheme === "dark" ? "#f1f3f4" : "#101418" },
      showlegend: false,
      customdata: [],
      hoverinfo: "skip",
    };
    return cells.length > 0 ? [sign] : [];
  };
  return [
    ...(pale.flat().includes(true) ? [veil] : []),
    ...signs(hatched, "line-ne-open"),
    ...signs(failing, "x-thin-open"),
  ];
}

export function mapFigure(input: Input): {
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
    customdata: grid.rows,
    text: grid.values.map((values, i) =>
      values.map((value, j) => (value === null ? "" : textOf(grid.rows[i]?.[j] ?? 0, value).join("<br>"))),
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
    }),
  };
}
