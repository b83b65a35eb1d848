/** The whole road as a thin strip: where the plots below look, and a place to point and zoom. */

import { Box, useComputedColorScheme } from "@mantine/core";
import { useMemo } from "react";
import type { FigureTemplate } from "../api/types";
import type { Scene } from "../lab/resultView";
import { Card } from "../ui/Card";
import { buildFigure, MARGIN } from "./figure";
import { Overlay } from "./Overlay";
import { PALETTES } from "./palettes";
import { useZoom } from "./PlotGrid";
import classes from "./plots.module.css";
import { Surface } from "./Surface";
import { usePlotly } from "./usePlotly";

interface Props {
  readonly template: FigureTemplate;
  readonly scene: Scene;
}

export function RoadStrip({ template, scene }: Props) {
  const plotly = usePlotly();
  const palette = PALETTES[useComputedColorScheme("light")];
  const onZoom = useZoom();
  const { series, summaries, strategies, axis, whole, range, shown } = scene;
  const figure = useMemo(
    () =>
      buildFigure({ template, series, driven: series, summaries, strategies, axis, range: whole, palette, yTicks: 3 }),
    [template, series, summaries, strategies, axis, whole, palette],
  );
  const { meta } = template.layout;
  const part = (x: number) => (x - whole[0]) / (whole[1] - whole[0]);
  const [left, right] = [part(range[0]), 1 - part(range[1])];
  return (
    <Card className={classes.strip ?? ""} aria-label={`${meta.title}, curves`} data-figure={meta.signal}>
      <div role="img" aria-label={`${meta.title} in ${meta.unit} over ${axis}, whole run`}>
        <Surface plotly={plotly} figure={figure} live={shown.source === "live"} />
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
    </Card>
  );
}
