/** Figures side by side, in the order the backend gives them. */

import { useComputedColorScheme, Box } from "@mantine/core";
import { createAtom } from "@tanstack/react-store";
import { memo, useCallback, useLayoutEffect, useMemo, useState } from "react";
import type { FigureTemplate } from "../api/types";
import type { Zoom } from "../lab/address";
import { useLabContext } from "../lab/context";
import { useIsolated } from "../lab/isolated";
import { partShown, type ResultView } from "../lab/resultView";
import { layersOf, sameCurves, type Curves } from "./curves";
import { PALETTES } from "./palettes";
import { EnlargeButton } from "./FigureButton";
import { PlotPanel } from "./PlotPanel";
import classes from "./plots.module.css";
import { curvesOf, subtrahend } from "./differences";
import { useCurves, useDetail, useLayered } from "./useDetail";
import { Card } from "../ui/Card";
import { buildFigure, MARGIN } from "./figure";
import { Overlay } from "./Overlay";
import { Surface, type CurvesSource } from "./Surface";

/** What all panels draw of a result: one for all of them, which follows a slider without rendering anything anew. */
export function useShownCurves(resultView: ResultView): CurvesSource {
  const { lab } = useLabContext();
  const { roads, ...pair } = useCurves(resultView);
  const own = useDetail(pair.own);
  const other = useDetail(pair.other);
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
    () => ({ ...curvesOf(resultView, own, other), ...beside, ...(roads !== undefined && { roads }) }),
    [resultView, own, other, beside, roads],
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
  const palette = PALETTES[useComputedColorScheme("light")];
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
  const palette = PALETTES[useComputedColorScheme("light")];
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
