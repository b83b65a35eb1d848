/** Figures side by side, in the order the backend gives them. */

import { useComputedColorScheme, Box, Group } from "@mantine/core";
import { createAtom, shallow, useSelector } from "@tanstack/react-store";
import { memo, useCallback, useLayoutEffect, useMemo, useState, useEffect, useRef, type PointerEvent } from "react";
import { type FigureTemplate, type FigureMeta, type SeriesByStrategy, type Strategy } from "../api/types";
import { type Zoom, type Axis } from "../lab/address";
import { useLabContext } from "../lab/context";
import { partShown, type ResultView, axisKey } from "../lab/resultView";
import { layersOf, sameCurves, shownCurves, type Curves, type CurvesSource, fileOf } from "./curves";
import { PALETTES, type Palette } from "./palettes";
import { EnlargeButton, FigureButton } from "./FigureButton";
import classes from "./plots.module.css";
import { curvesOf, subtrahend } from "./differences";
import { useCurves, useDetail, useLayered } from "./useDetail";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";
import { buildFigure, MARGIN, axisUnit } from "./figure";
import { Surface } from "./Surface";
import { useIntersection } from "@mantine/hooks";
import { printing } from "../lib/printing";
import { type FigureSource } from "./saved";
import { useCursor, useIsolated, cursor } from "../lab/cursor";
import { formatFixed } from "../units/format";
import { extent, valueAt } from "../lib/samples";
import { runAction } from "../lab/actions";
import { createTimer } from "../lib/timer";

/** What all panels draw of a result: one for all of them, which follows a slider without rendering anything anew. */
export function useShownCurves(resultView: ResultView): CurvesSource {
  const { lab } = useLabContext();
  const { roads, ...pair } = useCurves(resultView);
  const { series: own, waiting, failure } = useDetail(pair.own);
  const { series: other, waiting: otherWaits, failure: otherFailure } = useDetail(pair.other);
  const layered = useLayered(resultView);
  const { shown, differences, ids } = resultView;
  const standsOut = useIsolated();
  const isolated = standsOut !== null && ids.includes(standsOut) ? standsOut : null;
  const minus = differences ? subtrahend(resultView) : undefined;
  const layers = useMemo(
    () => (differences ? [] : layersOf(layered, shown.runId)),
    [differences, layered, shown.runId],
  );
  const beside = useMemo(
    () => ({ layers, isolated, ...(minus !== undefined && { minus }) }),
    [layers, isolated, minus],
  );
  const still = useMemo(
    () => ({
      ...curvesOf(resultView, own, other),
      ...beside,
      ...(roads !== undefined && { roads }),
      waiting: waiting || otherWaits,
      failure: failure ?? otherFailure,
    }),
    [resultView, own, other, beside, roads, waiting, otherWaits, failure, otherFailure],
  );
  const [source] = useState(() => createAtom<Curves>(still, { compare: sameCurves }));
  useLayoutEffect(() => {
    const follow = () => {
      const newest = lab.newest.get();
      if (newest?.source !== "live") source.set(still);
      else {
        const part = partShown(newest, resultView.strategies, ids, resultView);
        source.set({ ...curvesOf({ ...resultView, ...part }, part.series, other), ...beside });
      }
    };
    follow();
    const following = lab.newest.subscribe(follow);
    return () => following.unsubscribe();
  }, [lab, source, still, resultView, ids, other, beside]);
  useLayoutEffect(() => {
    shownCurves.set(source);
    return () => shownCurves.set(null);
  }, [source]);
  return source;
}

interface Props {
  readonly templates: readonly FigureTemplate[];
  readonly curves: CurvesSource;
}

export const PlotGrid = memo(function PlotGrid(props: Props) {
  const onZoom = useZoom();
  return (
    <div className={classes.grid}>
      <PlotPanels {...props} onZoom={onZoom} />
    </div>
  );
});

interface PanelsProps extends Props {
  readonly onZoom: (zoom: Zoom | null) => void;
}

export function PlotPanels({ templates, ...props }: PanelsProps) {
  const palette = usePalette();
  return templates.map((template) => (
    <PlotPanel key={template.layout.meta.signal} {...{ template, palette, ...props }} />
  ));
}

/** For panels that draw anew without being rendered anew, which would take longer than drawing. */
export function useCurvesSource<Drawn>(curves: Drawn) {
  const [source] = useState(() => createAtom(curves));
  useLayoutEffect(() => source.set(curves), [source, curves]);
  return source;
}

/** Zooms all plots; without a range from the bump to the whole run and back. */
export function useZoom(): (zoom: Zoom | null) => void {
  const { labAddress } = useLabContext();
  return useCallback(
    (zoom) => {
      const { zoom: before } = labAddress.get().view;
      labAddress.setView({ zoom: zoom ?? (before === "whole" ? null : "whole") });
    },
    [labAddress],
  );
}

interface RoadStripProps {
  readonly template: FigureTemplate;
  readonly resultView: ResultView;
}

/** The whole road as a thin strip: where the plots below look, and a place to point and zoom. */
export function RoadStrip({ template, resultView }: RoadStripProps) {
  const palette = usePalette();
  const onZoom = useZoom();
  const { series, summaries, strategies, axis, whole, range, shown } = resultView;
  const { runId, coreVersion, source } = shown;
  const curves = useMemo(
    () => ({
      ...{ series, sourceSeries: series, summaries, strategies, axis, range: whole },
      ...{ live: source === "live", runId, coreVersion },
    }),
    [series, summaries, strategies, axis, whole, source, runId, coreVersion],
  );
  const drawn = useCurvesSource(curves);
  const build = useCallback(
    (now: Curves) => buildFigure({ template, palette, ...now, yTicks: 3 }),
    [template, palette],
  );
  const { meta } = template.layout;
  const part = (x: number) => (x - whole[0]) / (whole[1] - whole[0]);
  const [left, right] = [part(range[0]), 1 - part(range[1])];
  return (
    <Card className={classes.strip ?? ""} aria-label={`${meta.title}, curves`} data-figure={meta.signal}>
      <div role="img" aria-label={`${meta.title} in ${meta.unit} over ${axis}, whole run`}>
        <Surface curves={drawn} build={build} visible />
        {range !== whole && (
          <div
            className={classes.stripWindow}
            style={{ inset: `${MARGIN.t}px ${MARGIN.r}px ${MARGIN.b}px ${MARGIN.l}px` }}
          >
            <div style={{ left: 0, width: `${100 * left}%` }} />
            <div style={{ right: 0, width: `${100 * right}%` }} />
          </div>
        )}
        <Overlay axis={axis} range={whole} onZoom={onZoom} />
      </div>
      <h2 className={classes.stripTitle}>
        {meta.title}{" "}
        <Box component="span" fw={400} c="dimmed">
          {meta.unit}
        </Box>
      </h2>
      <div className={classes.stripTools} data-unprinted>
        <EnlargeButton template={template} curves={drawn} />
      </div>
    </Card>
  );
}

/** Of the screen; paper is light. */
function usePalette(): Palette {
  const scheme = useComputedColorScheme("light");
  return PALETTES[useSelector(printing) ? "light" : scheme];
}

interface PlotPanelProps {
  readonly template: FigureTemplate;
  readonly curves: CurvesSource;
  readonly palette: Palette;
  readonly onZoom: (zoom: Zoom | null) => void;
}

const sourceOf = (template: FigureTemplate, curves: CurvesSource, file: string): FigureSource => ({
  title: template.layout.meta.title,
  file,
  paper: async (size) => (await import("./paperFigure")).paperFigure(template, curves.get(), size),
  csv: async () => (await import("./saved")).figureCsv(template, curves.get(), window.location.href),
});

/** What a panel says beside its curves: most answers under a moving slider leave it as it is. */
const headOf = ({ strategies, axis, range, runId, minus }: Curves) => ({ strategies, axis, range, runId, minus });

/** Panels this close to the window are drawn too, so that scrolling meets no blank ones. */
const NEAR = "40px 0px";

const PlotPanel = memo(function PlotPanel({ template, curves, palette, onZoom }: PlotPanelProps) {
  const { ref: viewRef, entry } = useIntersection<HTMLElement>({ rootMargin: NEAR });
  const printed = useSelector(printing);
  const inViewport = printed || (entry?.isIntersecting ?? false);
  const { meta } = template.layout;
  const { lab } = useLabContext();
  useEffect(() => (inViewport ? lab.draw(meta.signal) : undefined), [lab, inViewport, meta.signal]);
  const { strategies, axis, range, runId, minus } = useSelector(curves, headOf, { compare: sameCurves });
  const build = useCallback((drawn: Curves) => buildFigure({ template, palette, ...drawn }), [template, palette]);
  const drawn = strategies.map(({ label }) => label).join(", ");
  const part = `${axis} from ${formatFixed(range[0], 1)} to ${formatFixed(range[1], 1)} ${axisUnit(axis)}`;
  return (
    <Card ref={viewRef} className={classes.panel ?? ""} aria-label={`${meta.title}, curves`} data-figure={meta.signal}>
      <Group component="header" gap="0.5rem" wrap="nowrap" mih="2rem" p="0 0.7rem 0 0.8rem">
        <Box component="h2" flex="1 0 auto" maw="calc(100% - 7.2rem)" m={0} fz="sm" fw={600} lh="1.3">
          {meta.title}{" "}
          <Box component="span" fw={400} c="dimmed">
            {meta.unit}
            {minus !== undefined && `, change against ${minus}`}
          </Box>
        </Box>
        <Readouts {...{ meta, curves, strategies, axis }} />
        <Group gap={0} wrap="nowrap" flex="none" data-unprinted>
          <EnlargeButton template={template} curves={curves} />
          <FigureButton source={sourceOf(template, curves, fileOf(template, { runId }))} />
        </Group>
      </Group>
      <Box pos="relative" h={176} role="img" aria-label={`${meta.title} in ${meta.unit} over ${part}: ${drawn}`}>
        <Surface curves={curves} build={build} visible={inViewport} />
        <Overlay axis={axis} range={range} onZoom={onZoom} />
      </Box>
    </Card>
  );
});

interface ReadoutsProps {
  readonly meta: FigureMeta;
  readonly curves: CurvesSource;
  readonly strategies: readonly Strategy[];
  readonly axis: Axis;
}

/** As many decimals as give three digits to the run's largest value: the numbers keep their width while they change. */
function decimalsFor({ signal, scale }: FigureMeta, all: SeriesByStrategy): number {
  const ends = Object.values(all).flatMap((series) => (series[signal] ? (extent(series[signal]) ?? []) : []));
  const largest = Math.max(0, ...ends.map((value) => Math.abs(value * scale)));
  return largest > 0 ? Math.min(6, Math.max(0, 2 - Math.floor(Math.log10(largest)))) : 0;
}

/** The curves' values at the cursor, beside the panel's title. */
function Readouts({ meta, curves, strategies, axis }: ReadoutsProps) {
  const x = useCursor(axis);
  const texts = useSelector(curves, ({ series }) => readings(meta, series, strategies, axis, x), { compare: shallow });
  return (
    <span className={classes.readouts} data-empty={x === null || undefined} aria-hidden>
      {strategies.map(({ id, colour }, index) => (
        <span key={id} className={classes.readout}>
          <span className={ui.swatch} style={{ background: colour }} />
          {texts[index] ?? "–"}
        </span>
      ))}
    </span>
  );
}

function readings(
  meta: FigureMeta,
  series: SeriesByStrategy,
  strategies: readonly Strategy[],
  axis: Axis,
  x: number | null,
): readonly (string | null)[] {
  if (x === null) return [];
  const decimals = decimalsFor(meta, series);
  return strategies.map(({ id }) => {
    const [samples, values] = [series[id]?.[axisKey(axis)], series[id]?.[meta.signal]];
    const value = samples && values ? valueAt(samples, values, x) : null;
    return value === null ? null : formatFixed(value * meta.scale, decimals);
  });
}

/** Pointer, cursor line and zoom brush over one panel. The lines move without React: they follow every frame. */
interface OverlayProps {
  readonly axis: Axis;
  readonly range: Zoom;
  readonly onZoom: (zoom: Zoom | null) => void;
}

/** Shorter drags are clicks. */
const LEAST_DRAG_PX = 6;

function Overlay({ axis, range, onZoom }: OverlayProps) {
  const area = useRef<HTMLDivElement>(null);
  const line = useRef<HTMLDivElement>(null);
  const band = useRef<HTMLDivElement>(null);
  const [low, high] = range;

  useEffect(() => {
    const percent = (x: number) => `${((x - low) / (high - low)) * 100}%`;
    const drawLine = () => {
      const x = cursor.get(axis);
      if (!line.current) return;
      const visible = x !== null && x >= low && x <= high;
      line.current.style.display = visible ? "block" : "none";
      if (visible) line.current.style.left = percent(x);
    };
    const drawBand = () => {
      const stretch = brush.get();
      if (!band.current) return;
      band.current.style.display = stretch ? "block" : "none";
      if (!stretch) return;
      const [from, to] = [Math.min(stretch.from, stretch.to), Math.max(stretch.from, stretch.to)];
      band.current.style.left = percent(from);
      band.current.style.width = `${((to - from) / (high - low)) * 100}%`;
    };
    drawLine();
    drawBand();
    const stops = [cursor.subscribe(drawLine), brush.subscribe(drawBand)];
    return () => {
      for (const stop of stops) stop.unsubscribe();
    };
  }, [axis, low, high]);

  const positionOf = (event: PointerEvent) => {
    const box = area.current?.getBoundingClientRect();
    if (!box || box.width === 0) return low;
    const part = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    return low + part * (high - low);
  };
  const widthOf = (stretch: { from: number; to: number }) =>
    (Math.abs(stretch.to - stretch.from) / (high - low)) * (area.current?.clientWidth ?? 0);

  return (
    <div
      ref={area}
      role="presentation" // the cursor has a slider under the car, the zoom its buttons
      className={classes.overlay}
      style={{ inset: `${MARGIN.t}px ${MARGIN.r}px ${MARGIN.b}px ${MARGIN.l}px` }}
      onPointerDown={(event) => {
        cursor.set(axis, positionOf(event));
        if (event.pointerType !== "mouse" || event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        brush.set({ from: positionOf(event), to: positionOf(event) });
      }}
      onPointerMove={(event) => {
        cursor.set(axis, positionOf(event));
        const stretch = brush.get();
        if (stretch) brush.set({ ...stretch, to: positionOf(event) });
      }}
      onPointerUp={() => {
        const stretch = brush.get();
        brush.set(null);
        if (!stretch) return;
        if (widthOf(stretch) < LEAST_DRAG_PX) {
          click.start();
          return;
        }
        onZoom([Math.min(stretch.from, stretch.to), Math.max(stretch.from, stretch.to)]);
      }}
      onPointerCancel={() => brush.set(null)}
      onDoubleClick={() => {
        click.stop();
        onZoom(null);
      }}
    >
      <div ref={band} className={classes.brush} />
      <div ref={line} className={classes.cursor} />
    </div>
  );
}

/** A second click within this makes it a double click [ms]. */
const DOUBLE_CLICK_MS = 250;

/** One click looks at the instant under the cursor. */
const click = createTimer(DOUBLE_CLICK_MS, () => runAction("instant"));

/** The stretch being drawn with the pointer to zoom into; all panels show it. */
interface Brush {
  readonly from: number;
  readonly to: number;
}

const brush = createAtom<Brush | null>(null);
