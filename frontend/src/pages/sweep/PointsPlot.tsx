/** Runs as points in their strategy's colour: a metric over a swept field, or over another metric. */

import { Group, Text } from "@mantine/core";
import { useCallback, useMemo, useState, useEffect, useEffectEvent, useRef, type RefObject } from "react";
import { type Batch, type Strategy } from "../../api/types";
import { Icon } from "../../ui/icons";
import { isFinal } from "../../jobs/useJob";
import { Chart } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { useCatalogue } from "../../server/useCatalogues";
import { count, formatWhole, formatWithUnit } from "../../units/format";
import { axesOf, type AxisOf, cell, pointsOf, type Columns } from "../../features/sweep/table";
import classes from "./sweep.module.css";
import { isAirborne, fieldTexts, type ShownPlot, type PlotParts, type SweepParts, useMarkers } from "./view";
import { fullName } from "../../server/metrics";
import { frontOf, linesOf, scatterFigure, type Dots } from "./scatter";
import ui from "../../ui/ui.module.css";
import { type PlotElement } from "../../plots/plotly";
import plots from "../../plots/plots.module.css";
import { outlineOf } from "../../plots/markers";

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
    const others = axes.map(({ name }) => name).filter((name) => name !== x.name);
    const lines = joined ? linesOf(columns, points, others) : [];
    const isHollow = (row: number) => isAirborne(columns, row);
    const ringed = tradeOff ? front : best === null ? NONE : [best];
    const input = { points, markers, x, y, ringed, front: tradeOff, lines, curves, isHollow, textOf };
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
  if (batch.done > 0 && !columns.status?.includes("ok")) return "Loading the runs that have finished…";
  return `No run of the strategies shown has this metric${isFinal(batch) ? "" : " yet"}.`;
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

/** The canvas of a sweep with many runs, and what it says of the point under the pointer. */
interface DotLayerProps {
  /** Where plotly has drawn the axes. */
  readonly host: RefObject<HTMLDivElement | null>;
  /** Counts plotly's drawings: a new one means new axes. */
  readonly drawing: number;
  readonly dots: readonly Dots[];
  readonly width: number;
  readonly height: number;
  /** What a row says of itself, line by line. */
  readonly textOf: (row: number) => readonly string[];
  readonly onOpen: (row: number) => void;
  /** It cannot be told where plotly's axes lie: the points have to be plotly's own. */
  readonly onNoAxes: () => void;
}

const REACH_PX = 12;
/** Further is a drag, which zooms. */
const CLICK_PX = 4;

function DotLayer({ host, drawing, dots, width, height, textOf, onOpen, onNoAxes }: DotLayerProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawn = useRef<{ readonly located: readonly LocatedDots[]; readonly axes: Axes } | null>(null);
  const [hit, setHit] = useState<Hit | null>(null);

  // Other dots come with a new drawing: before it they would lie on axes of the last.
  const paint = useEffectEvent((element: PlotElement) => {
    if (!canvas.current) return;
    setHit(null);
    const axes = dots.length === 0 ? null : drawnAxes(element);
    if (!axes) {
      drawn.current = null;
      clearDots(canvas.current);
      if (dots.length > 0) onNoAxes();
      return;
    }
    const located = locate(dots, axes);
    drawn.current = { located, axes };
    drawDots(canvas.current, located, axes, { width, height }, () => drawn.current?.located === located);
  });
  useEffect(() => {
    const element = host.current as PlotElement | null;
    if (drawing === 0 || !element) return undefined;
    paint(element);
    element.on("plotly_relayout", () => paint(element));
    return () => element.removeAllListeners?.("plotly_relayout");
  }, [host, drawing]);

  const open = useEffectEvent((row: number) => onOpen(row));
  useEffect(() => {
    const element = host.current;
    if (!element) return undefined;
    let pressed: readonly [number, number] | null = null;
    const find = (event: PointerEvent) => {
      const box = element.getBoundingClientRect();
      return (
        drawn.current &&
        nearest(drawn.current.located, drawn.current.axes, event.clientX - box.left, event.clientY - box.top, REACH_PX)
      );
    };
    const move = (event: PointerEvent) => setHit(event.buttons === 0 ? find(event) : null);
    const leave = () => setHit(null);
    const press = (event: PointerEvent) => {
      pressed = event.button === 0 ? [event.clientX, event.clientY] : null;
    };
    // On the window: plotly covers the page while a button is down.
    const release = (event: PointerEvent) => {
      const near = pressed !== null && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < CLICK_PX;
      pressed = null;
      const row = near ? find(event) : null;
      if (row) open(row.dots.rows[row.index] ?? 0);
    };
    const listening = new AbortController();
    const { signal } = listening;
    element.addEventListener("pointermove", move, { signal });
    element.addEventListener("pointerleave", leave, { signal });
    element.addEventListener("pointerdown", press, { signal, capture: true });
    window.addEventListener("pointerup", release, { signal, capture: true });
    return () => listening.abort();
  }, [host]);

  const row = hit?.dots.rows[hit.index];
  return (
    <>
      <canvas ref={canvas} className={plots.canvas} aria-hidden />
      {hit && row !== undefined && (
        <div
          className={classes.tip}
          data-left={hit.x > width / 2 || undefined}
          style={{ left: hit.x, top: hit.y }}
          aria-hidden
        >
          <span className={classes.tipRing} style={{ borderColor: hit.dots.colour }} />
          <span className={classes.tipText} data-testid="tip">
            {textOf(row).map((line) => (
              <span key={line}>{line}</span>
            ))}
          </span>
        </div>
      )}
    </>
  );
}

/** The part of plotly's axis that says where a value lies. */
interface DrawnAxis {
  /** [px] from the figure's edge. */
  readonly _offset: number;
  readonly _length: number;
  readonly d2p: (value: number | string) => number;
}

interface Axes {
  readonly xaxis: DrawnAxis;
  readonly yaxis: DrawnAxis;
}

const isDrawnAxis = (axis: Partial<DrawnAxis> | undefined) =>
  typeof axis?._offset === "number" && typeof axis._length === "number" && typeof axis.d2p === "function";

/** The axes plotly has drawn in an element. They are no part of its documented interface: `null` where a version of it has others. */
export function drawnAxes(element: HTMLElement): Axes | null {
  const { _fullLayout: layout } = element as { readonly _fullLayout?: Partial<Axes> };
  return layout && isDrawnAxis(layout.xaxis) && isDrawnAxis(layout.yaxis) ? (layout as Axes) : null;
}

interface LocatedDots {
  readonly dots: Dots;
  /** [px] from the figure's corner. */
  readonly x: Float32Array;
  readonly y: Float32Array;
}

interface Hit {
  readonly dots: Dots;
  readonly index: number;
  readonly x: number;
  readonly y: number;
}

const HALF = 2.5;

export function locate(all: readonly Dots[], { xaxis, yaxis }: Axes): readonly LocatedDots[] {
  return all.map((dots) => ({
    dots,
    x: Float32Array.from(dots.x, (value) => xaxis._offset + xaxis.d2p(value)),
    y: Float32Array.from(dots.y, (value) => yaxis._offset + yaxis.d2p(value)),
  }));
}

const inside = ({ xaxis, yaxis }: Axes, x: number, y: number) =>
  x >= xaxis._offset && x <= xaxis._offset + xaxis._length && y >= yaxis._offset && y <= yaxis._offset + yaxis._length;

/** The nearest point within reach that is in sight; of points one upon the other, the one drawn last. */
export function nearest(located: readonly LocatedDots[], axes: Axes, x: number, y: number, radius: number): Hit | null {
  let nearest: Hit | null = null;
  let least = radius * radius;
  for (const { dots, x: xs, y: ys } of located) {
    for (let index = 0; index < xs.length; index++) {
      const [atX = NaN, atY = NaN] = [xs[index], ys[index]];
      const distance = (atX - x) ** 2 + (atY - y) ** 2;
      if (distance > least || !inside(axes, atX, atY)) continue;
      least = distance;
      nearest = { dots, index, x: atX, y: atY };
    }
  }
  return nearest;
}

/** One symbol, drawn once and then copied. */
function stamp({ colour, symbol }: Dots, hollow: boolean, ratio: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = Math.ceil((2 * HALF + 4) * ratio);
  const context = canvas.getContext("2d");
  if (!context) return canvas;
  context.scale(ratio, ratio);
  context.translate(HALF + 2, HALF + 2);
  context.globalAlpha = 0.75;
  const outline = new Path2D(outlineOf(symbol, HALF));
  if (hollow) {
    context.strokeStyle = colour;
    context.stroke(outline);
  } else {
    context.fillStyle = colour;
    context.fill(outline);
  }
  return canvas;
}

function clearDots(canvas: HTMLCanvasElement): void {
  canvas.getContext("2d")?.clearRect(0, 0, canvas.width, canvas.height);
}

/** In one task, of some milliseconds. */
const AT_ONCE = 2500;

/** In pieces, until they are no longer wanted. */
function drawDots(
  canvas: HTMLCanvasElement,
  located: readonly LocatedDots[],
  { xaxis, yaxis }: Axes,
  { width, height }: { readonly width: number; readonly height: number },
  areWanted: () => boolean,
): void {
  const ratio = window.devicePixelRatio;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context) return;
  context.beginPath();
  context.rect(xaxis._offset * ratio, yaxis._offset * ratio, xaxis._length * ratio, yaxis._length * ratio);
  context.clip();
  const pieces = located.flatMap(({ dots, x, y }) => {
    const [full, hollow] = [stamp(dots, false, ratio), stamp(dots, true, ratio)];
    const shift = full.width / 2;
    return Array.from({ length: Math.ceil(x.length / AT_ONCE) }, (_, piece) => () => {
      for (let index = AT_ONCE * piece; index < Math.min(AT_ONCE * (piece + 1), x.length); index++) {
        context.drawImage(
          dots.hollow[index] === true ? hollow : full,
          (x[index] ?? 0) * ratio - shift,
          (y[index] ?? 0) * ratio - shift,
        );
      }
    });
  });
  const draw = (piece: number) => {
    if (!areWanted()) return;
    pieces[piece]?.();
    if (piece + 1 < pieces.length) setTimeout(() => draw(piece + 1));
  };
  draw(0);
}
