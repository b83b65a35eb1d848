/** The drawn part of a panel: plotly's graph, and the canvas that stands in for it. */

import { useElementSize } from "@mantine/hooks";
import { useEffect, useRef } from "react";
import { PanelPainter } from "./painter";
import type { PanelFigure, Plotly } from "./plotly";
import classes from "./plots.module.css";

interface Props {
  readonly plotly: Plotly | null;
  readonly figure: PanelFigure | null;
  readonly live: boolean;
}

export function Surface({ plotly, figure, live }: Props) {
  const { ref: sizeRef, width, height } = useElementSize<HTMLDivElement>();
  const host = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useRef<PanelPainter>(null);

  useEffect(() => {
    if (!host.current || !canvas.current) return undefined;
    const panelPainter = new PanelPainter(host.current, canvas.current);
    painter.current = panelPainter;
    return () => {
      painter.current = null;
      panelPainter.dispose();
    };
  }, []);

  useEffect(() => {
    if (figure && width > 0) painter.current?.paint(figure, { width, height }, live, plotly);
  }, [plotly, figure, live, width, height]);

  return (
    <div ref={sizeRef} className={classes.surface}>
      <div ref={host} className={classes.graph} />
      <canvas ref={canvas} className={classes.live} aria-hidden />
    </div>
  );
}
