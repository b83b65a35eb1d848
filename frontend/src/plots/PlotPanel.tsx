/** One figure: title, readouts, curves, and the pointer's layer over them. */

import { useIntersection } from "@mantine/hooks";
import { memo, useMemo } from "react";
import type { FigureTemplate, SeriesByStrategy } from "../api/types";
import type { Zoom } from "../state/address";
import { printing } from "../state/printing";
import type { Scene } from "../state/scene";
import { useStore } from "../state/store";
import { buildFigure, type Palette } from "./figure";
import { Overlay } from "./Overlay";
import classes from "./plots.module.css";
import type { Plotly } from "./plotly";
import { Readouts } from "./Readouts";
import { Surface } from "./Surface";
import { Card } from "../ui/Card";

interface Props {
  readonly plotly: Plotly | null;
  readonly template: FigureTemplate;
  readonly scene: Scene;
  readonly series: SeriesByStrategy;
  readonly palette: Palette;
  readonly onZoom: (zoom: Zoom | null) => void;
}

/** Panels this close to the window are drawn too, so that scrolling meets no blank ones. */
const NEAR = "40px 0px";

export const PlotPanel = memo(function PlotPanel({ plotly, template, scene, series, palette, onZoom }: Props) {
  const { ref: viewRef, entry } = useIntersection<HTMLElement>({ rootMargin: NEAR });
  const printed = useStore(printing);
  const inViewport = printed || (entry?.isIntersecting ?? false);
  const { meta } = template.layout;
  // Off screen nothing is computed: during a drag only what somebody sees is drawn anew.
  const figure = useMemo(
    () =>
      inViewport
        ? buildFigure({ template, series, summaries: scene.summaries, strategies: scene.ids, axis: scene.axis, range: scene.range, palette })
        : null,
    [inViewport, template, series, scene, palette],
  );
  const drawn = scene.strategies.map(({ label }) => label).join(", ");
  return (
    <Card ref={viewRef} aria-label={meta.title} data-figure={meta.signal}>
      <header className={classes.header}>
        <h3 className={classes.title}>
          {meta.title} <span className={classes.unit}>{meta.unit}</span>
        </h3>
        <Readouts meta={meta} series={series} strategies={scene.strategies} axis={scene.axis} />
      </header>
      <div className={classes.canvas} role="img" aria-label={`${meta.title} in ${meta.unit} over ${scene.axis}: ${drawn}`}>
        <Surface plotly={plotly} figure={figure} live={scene.shown.source === "live"} />
        <Overlay range={scene.range} onZoom={onZoom} />
      </div>
    </Card>
  );
});
