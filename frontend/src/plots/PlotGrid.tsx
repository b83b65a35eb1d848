/** Figures side by side, in the order the backend gives them. */

import { useComputedColorScheme } from "@mantine/core";
import { useCallback, useMemo } from "react";
import type { FigureTemplate } from "../api/types";
import type { Zoom } from "../state/address";
import { useDesk } from "../state/context";
import type { Scene } from "../state/scene";
import { layersOf } from "./layers";
import { PALETTES } from "./palettes";
import { PlotPanel } from "./PlotPanel";
import classes from "./plots.module.css";
import { useDetail } from "./useDetail";
import { usePlotly } from "./usePlotly";

interface Props {
  readonly templates: readonly FigureTemplate[];
  readonly scene: Scene;
}

export function PlotGrid({ templates, scene }: Props) {
  const plotly = usePlotly();
  const palette = PALETTES[useComputedColorScheme("light")];
  const series = useDetail(scene);
  const onZoom = useZoom();
  const { summaries, strategies, axis, range, shown, before, pins } = scene;
  const layers = useMemo(() => layersOf({ shown, before, pins }), [shown, before, pins]);
  const curves = useMemo(
    () => ({ series, layers, summaries, strategies, axis, range, live: shown.source === "live" }),
    [series, layers, summaries, strategies, axis, range, shown.source],
  );
  return (
    <div className={classes.grid}>
      {templates.map((template) => (
        <PlotPanel key={template.layout.meta.signal} plotly={plotly} template={template} curves={curves} palette={palette} onZoom={onZoom} />
      ))}
    </div>
  );
}

/** Zooms all plots; without a range from the bump to the whole run and back. */
export function useZoom(): (zoom: Zoom | null) => void {
  const { router } = useDesk();
  return useCallback(
    (zoom) => {
      const { zoom: before } = router.get().view;
      router.setView({ zoom: zoom ?? (before === "whole" ? null : "whole") });
    },
    [router],
  );
}
