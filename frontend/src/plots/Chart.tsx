/** One small plot of its own: drawn anew when its figure or its width changes; points can be clicked. */

import { Button } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import { useSelector } from "@tanstack/react-store";
import { useEffect, useEffectEvent, useRef, useState, type ReactNode, type RefObject } from "react";
import type { MadeTrace } from "../api/types";
import classes from "./plots.module.css";
import { printing } from "../lib/printing";
import { Fault } from "../ui/Messages";
import {
  plotlyState,
  requestPlotly,
  type Plotly,
  type BarTrace,
  type GridTrace,
  type LineTrace,
  type PlotElement,
  type PlotLayout,
  type PlotTrace,
  type PointTrace,
} from "./plotly";

export interface ChartFigure {
  readonly data: readonly (
    | (PlotTrace & { readonly name: string })
    | PointTrace
    | LineTrace
    | BarTrace
    | GridTrace
    | MadeTrace
  )[];
  readonly layout: PlotLayout;
}

interface Props {
  /** `null` draws nothing yet; what was drawn stays. */
  readonly figure: ChartFigure | null;
  readonly height: number;
  /** Instead of as wide as there is room for [px]. */
  readonly width?: number | undefined;
  /** What it shows, in words, for whoever does not see it. */
  readonly label: string;
  /** Gets the `customdata` of a clicked point. */
  readonly onPoint?: (point: number) => void;
  /** Gets the element that it is drawn in. */
  readonly hostRef?: RefObject<HTMLDivElement | null>;
  /** What lies over it, once it is as wide as that; it counts plotly's drawings, as a new one means new axes. */
  readonly over?: (drawing: number, width: number) => ReactNode;
  /** It can be zoomed, panned and saved, as a file of this name. */
  readonly tools?: string;
  /** How many points it shows, where that matters to who looks for it; without any its axes mean nothing. */
  readonly points?: number;
}

const CONFIG = { displayModeBar: false, responsive: false, doubleClick: "reset", showTips: false } as const;
const TOOLS = {
  ...CONFIG,
  displayModeBar: true,
  displaylogo: false,
  showSendToCloud: false,
  doubleClick: "reset+autosize",
  scrollZoom: true,
};

export function Chart(props: Props) {
  const { figure, height, width: fixedWidth, label, onPoint, hostRef, over, tools, points: count } = props;
  const plotly = usePlotly();
  const { ref, width: room } = useElementSize<HTMLDivElement>();
  const width = fixedWidth ?? room;
  const own = useRef<HTMLDivElement>(null);
  const host = hostRef ?? own;

  const [drawing, setDrawing] = useState(0);
  const covered = over !== undefined;
  useEffect(() => {
    const element = host.current as PlotElement | null;
    if (!plotly || !figure || !element || width === 0) return undefined;
    let mounted = true;
    const config =
      tools === undefined ? CONFIG : { ...TOOLS, toImageButtonOptions: { format: "svg", filename: tools } };
    const draw = () => {
      void plotly.react(element, figure.data, { ...figure.layout, width, height }, config).then(() => {
        element.style.aspectRatio = `${width} / ${height}`;
        for (const svg of element.querySelectorAll(".main-svg")) svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
        if (mounted && covered) setDrawing((before) => before + 1);
      });
    };
    // Drawn again in a task of its own: what else the page shows of the same answer takes one already. Paper waits for none.
    let timer: ReturnType<typeof setTimeout> | undefined;
    if (element.removeAllListeners && !printing.get()) timer = setTimeout(draw);
    else draw();
    return () => {
      mounted = false;
      clearTimeout(timer);
    };
  }, [plotly, figure, host, width, height, covered, tools]);

  const clicked = useEffectEvent((point: number) => onPoint?.(point));
  const clickable = onPoint !== undefined;
  useEffect(() => {
    const element = host.current as PlotElement | null;
    if (!plotly || !element || width === 0 || !clickable) return undefined;
    element.on("plotly_click", ({ points }) => {
      const point = points[0]?.customdata;
      if (point !== undefined) clicked(point);
    });
    return () => element.removeAllListeners?.("plotly_click");
  }, [plotly, host, width, clickable]);
  useEffect(() => {
    const element = host.current;
    return () => {
      if (plotly && element) plotly.purge(element);
    };
  }, [plotly, host]);

  return (
    <div ref={ref} className={classes.chart} style={{ height }}>
      <PlotlyFault />
      <div
        ref={host}
        role={tools === undefined ? "img" : "group"}
        aria-label={label}
        data-points={count}
        data-empty={count === 0 || undefined}
      />
      {over?.(drawing, width)}
    </div>
  );
}

/** Says that plotly.js could not be loaded, and tries again. */
function PlotlyFault() {
  const { failed } = useSelector(plotlyState);
  if (!failed) return null;
  return (
    <Fault size="md">
      The plot library could not be loaded.{" "}
      <Button size="compact-xs" variant="light" onClick={requestPlotly}>
        Try again
      </Button>
    </Fault>
  );
}

/** plotly.js, asked for where something is drawn by it; `null` until it is there. */
function usePlotly(): Plotly | null {
  useEffect(requestPlotly, []);
  return useSelector(plotlyState).plotly;
}
