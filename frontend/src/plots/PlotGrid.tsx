/** All figures, in the order the backend gives them. */

import { useQuery } from "@tanstack/react-query";
import { useComputedColorScheme } from "@mantine/core";
import type { FigureTemplate } from "../api/types";
import type { Zoom } from "../state/address";
import { useDesk } from "../state/context";
import { DETAIL_POINTS, seriesQuery } from "../state/queries";
import type { Scene } from "../state/scene";
import { PALETTES } from "./palettes";
import { PlotPanel } from "./PlotPanel";
import classes from "./plots.module.css";
import { usePlotly } from "./usePlotly";

/** Zoomed in further than this part of the run, the overview's samples are too coarse. */
const DETAIL_BELOW = 0.5;

interface Props {
  readonly figures: Readonly<Record<string, FigureTemplate>>;
  readonly scene: Scene;
}

export function PlotGrid({ figures, scene }: Props) {
  const { router } = useDesk();
  const plotly = usePlotly();
  const palette = PALETTES[useComputedColorScheme("light")];
  const series = useDetail(scene);
  const onZoom = (zoom: Zoom | null) => router.setView({ zoom });
  return (
    <div className={classes.grid}>
      {Object.entries(figures).map(([name, template]) => (
        <PlotPanel key={name} plotly={plotly} template={template} scene={scene} series={series} palette={palette} onZoom={onZoom} />
      ))}
    </div>
  );
}

/** The exact run's finer samples once somebody looks closely; the overview until they are there. */
function useDetail({ shown, range, whole }: Scene) {
  const close = range[1] - range[0] < DETAIL_BELOW * (whole[1] - whole[0]);
  const detail = useQuery({
    ...seriesQuery(shown.runId ?? "", Object.keys(shown.summaries), DETAIL_POINTS),
    enabled: close && shown.runId !== null,
  });
  return close && shown.runId !== null && detail.data ? detail.data : shown.series;
}
