/** Figures side by side, in the order the backend gives them. */

import { useComputedColorScheme } from "@mantine/core";
import { useCallback, useMemo } from "react";
import type { FigureTemplate } from "../api/types";
import type { Zoom } from "../lab/address";
import { useLabContext } from "../lab/context";
import type { Scene } from "../lab/resultView";
import { layersOf } from "./curves";
import { PALETTES } from "./palettes";
import { PlotPanel } from "./PlotPanel";
import classes from "./plots.module.css";
import { drawnOf, subtrahend } from "./differences";
import { useCurves, useDetail, useLayered } from "./useDetail";
import { usePlotly } from "./usePlotly";

interface Props {
  readonly templates: readonly FigureTemplate[];
  readonly scene: Scene;
}

export function PlotGrid({ templates, scene }: Props) {
  const plotly = usePlotly();
  const palette = PALETTES[useComputedColorScheme("light")];
  const { roads, ...pair } = useCurves(scene);
  const own = useDetail(pair.own);
  const other = useDetail(pair.other);
  const onZoom = useZoom();
  const layered = useLayered(scene);
  const { strategies, axis, range, shown, differences, baseline, ids, summaries } = scene;
  // What changes are against is drawn only in plots of the differences.
  const [base, against] = differences ? [baseline, scene.against] : [null, null];
  const drawn = useMemo(
    () => drawnOf({ differences, against, baseline: base, ids, axis, range, summaries }, own, other),
    [differences, against, base, ids, axis, range, summaries, own, other],
  );
  const minus = differences ? subtrahend(scene) : undefined;
  const layers = useMemo(() => (differences ? [] : layersOf(layered)), [differences, layered]);
  const curves = useMemo(
    () => ({
      ...drawn,
      layers,
      strategies,
      axis,
      range,
      live: shown.source === "live",
      runId: shown.runId,
      coreVersion: shown.coreVersion,
      ...(roads !== undefined && { roads }),
      ...(minus !== undefined && { minus }),
    }),
    [drawn, layers, strategies, axis, range, shown.source, shown.runId, shown.coreVersion, roads, minus],
  );
  return (
    <div className={classes.grid}>
      {templates.map((template) => (
        <PlotPanel
          key={template.layout.meta.signal}
          plotly={plotly}
          template={template}
          curves={curves}
          palette={palette}
          onZoom={onZoom}
        />
      ))}
    </div>
  );
}

/** Zooms all plots; without a range from the bump to the whole run and back. */
export function useZoom(): (zoom: Zoom | null) => void {
  const { router } = useLabContext();
  return useCallback(
    (zoom) => {
      const { zoom: before } = router.get().view;
      router.setView({ zoom: zoom ?? (before === "whole" ? null : "whole") });
    },
    [router],
  );
}
