/** The drawn part of a panel: a canvas, which follows a slider at any pace. */

import { Box, Text } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import { useCallback, useLayoutEffect, useRef } from "react";
import { endFirstView } from "../lib/firstCurves";
import { printing } from "../lib/printing";
import { useSelector, type ReadonlyAtom } from "@tanstack/react-store";
import type { Curves } from "./curves";
import { withVerticalRange, MARGIN } from "./figure";
import type { PanelFigure, PlotTrace } from "./plotly";
import ui from "../ui/ui.module.css";
import classes from "./plots.module.css";
import type { Numbers } from "../lib/samples";
import type { Shape } from "./shapes";

interface Props<Drawn> {
  readonly curves: Pick<ReadonlyAtom<Drawn>, "get" | "subscribe">;
  readonly build: (curves: Drawn) => PanelFigure;
  /** Off screen nothing is computed: what was drawn stays. */
  readonly visible: boolean;
}

type Range = readonly [number, number];

/** Pixels of paper for one of the screen: 288 to the inch. */
const PAPER_RATIO = 3;

export function Surface<Drawn extends Pick<Curves, "live">>({ curves, build, visible }: Props<Drawn>) {
  const { ref: sizeRef, width, height } = useElementSize<HTMLDivElement>();
  const canvas = useRef<HTMLCanvasElement>(null);
  const shownRange = useRef<Range>(null);
  const printed = useSelector(printing);

  useLayoutEffect(() => {
    const drawn = canvas.current;
    if (!visible || width === 0 || !drawn) return undefined;
    const { fontFamily } = getComputedStyle(drawn);
    const draw = () => {
      const figure = build(curves.get());
      const needed = figure.layout.yaxis.range;
      const range = curves.get().live && keepsRange(shownRange.current, needed) ? shownRange.current : needed;
      shownRange.current = range;
      const ratio = printed ? PAPER_RATIO : window.devicePixelRatio;
      drawOnCanvas(
        drawn,
        range === needed ? figure : withVerticalRange(figure, range),
        { width, height },
        ratio,
        fontFamily,
      );
      endFirstView();
      const count = String(figure.data.length);
      if (drawn.dataset.drawn !== count) drawn.dataset.drawn = count;
    };
    draw();
    const following = curves.subscribe(draw);
    return () => following.unsubscribe();
  }, [curves, build, visible, width, height, printed]);

  return (
    <div ref={sizeRef} className={classes.surface}>
      <canvas ref={canvas} className={classes.canvas} aria-hidden />
    </div>
  );
}

const STILL = { get: () => ({ live: false }), subscribe: () => ({ unsubscribe: () => undefined }) };

/** A figure that is drawn when it is rendered. */
export function StillSurface({ figure }: { readonly figure: PanelFigure }) {
  return <Surface curves={STILL} build={useCallback(() => figure, [figure])} visible />;
}

interface SmallFigureProps {
  readonly title: string;
  readonly unit: string;
  /** What is drawn, for whoever does not see it. */
  readonly label: string;
  readonly height: number;
  readonly figure: PanelFigure;
}

/** The same under its title. */
export function SmallFigure({ title, unit, label, height, figure }: SmallFigureProps) {
  return (
    <Box component="figure" m={0}>
      <Text component="figcaption" size="xs" fw={600}>
        {title} <span className={ui.dim}>[{unit}]</span>
      </Text>
      <Box pos="relative" h={height} role="img" aria-label={label}>
        <StillSurface figure={figure} />
      </Box>
    </Box>
  );
}

/** A range already shown is kept while live curves fit in and fill at least this part of it: axes must not flicker. */
const LEAST_FILLED = 0.55;

export function keepsRange(shown: Range | null, needed: Range): shown is Range {
  if (shown === null) return false;
  const fits = needed[0] >= shown[0] && needed[1] <= shown[1];
  return fits && needed[1] - needed[0] >= LEAST_FILLED * (shown[1] - shown[0]);
}

interface Size {
  readonly width: number;
  readonly height: number;
}

interface Frame {
  readonly toX: (x: number) => number;
  readonly toY: (y: number) => number;
  readonly width: number;
  readonly height: number;
}

const AT_LEAST_PX = 3;
const TICK_PX = 11;

/** Dash lengths as plotly draws them. */
function dashOf(style: unknown, lineWidth: number): number[] {
  const unit = Math.max(lineWidth, AT_LEAST_PX);
  switch (style) {
    case "dot":
      return [unit, unit];
    case "dash":
      return [3 * unit, 3 * unit];
    case "longdash":
      return [5 * unit, 5 * unit];
    case "dashdot":
      return [3 * unit, unit, unit, unit];
    case "longdashdot":
      return [5 * unit, unit, unit, unit];
    default: // lengths, or solid
      return typeof style === "string" ? style.split(",").map(parseFloat).filter(Number.isFinite) : [];
  }
}

const asNumber = (value: unknown, otherwise: number) => (typeof value === "number" ? value : otherwise);
const asText = (value: unknown, otherwise: string) => (typeof value === "string" ? value : otherwise);

function drawShape(context: CanvasRenderingContext2D, shape: Shape, frame: Frame): void {
  const across = (value: unknown) =>
    shape.xref === "paper" ? asNumber(value, 0) * frame.width : frame.toX(asNumber(value, 0));
  const up = (value: unknown) =>
    shape.yref === "paper" ? (1 - asNumber(value, 0)) * frame.height : frame.toY(asNumber(value, 0));
  const [left, right, bottom, top] = [across(shape.x0), across(shape.x1), up(shape.y0), up(shape.y1)];
  context.globalAlpha = asNumber(shape.opacity, 1);
  if (shape.type === "line") {
    const line = shape.line as Readonly<Record<string, unknown>>;
    const width = asNumber(line.width, 1);
    drawLine(context, [left, bottom, right, top], asText(line.color, "#868e96"), width, dashOf(line.dash, width));
  } else {
    context.fillStyle = asText(shape.fillcolor, "transparent");
    context.fillRect(left, top, right - left, bottom - top);
  }
  context.globalAlpha = 1;
}

function drawLine(
  context: CanvasRenderingContext2D,
  [x0, y0, x1, y1]: readonly [number, number, number, number],
  colour: string,
  width = 1,
  dash: number[] = [],
): void {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

function tracePath(context: CanvasRenderingContext2D, x: Numbers, y: Numbers, frame: Frame): void {
  context.beginPath();
  for (let i = 0; i < x.length; i++) context.lineTo(frame.toX(x[i] ?? 0), frame.toY(y[i] ?? 0));
  context.stroke();
}

/** Between a trace and the one before it. */
function fillBetween(context: CanvasRenderingContext2D, trace: PlotTrace, before: PlotTrace, frame: Frame): void {
  context.beginPath();
  for (let i = 0; i < before.x.length; i++) context.lineTo(frame.toX(before.x[i] ?? 0), frame.toY(before.y[i] ?? 0));
  for (let i = trace.x.length - 1; i >= 0; i--) context.lineTo(frame.toX(trace.x[i] ?? 0), frame.toY(trace.y[i] ?? 0));
  context.fillStyle = asText(trace.fillcolor, "transparent");
  context.fill();
}

function drawTrace(context: CanvasRenderingContext2D, { x, y, line, opacity = 1 }: PlotTrace, frame: Frame): void {
  if (line.width === 0) return;
  context.strokeStyle = asText(line.color, "#868e96");
  context.lineWidth = asNumber(line.width, 1.5);
  context.lineJoin = "round";
  context.globalAlpha = opacity;
  context.setLineDash(dashOf(line.dash, context.lineWidth));
  tracePath(context, x, y, frame);
  context.globalAlpha = 1;
}

function drawGrid(context: CanvasRenderingContext2D, { layout: { xaxis, yaxis } }: PanelFigure, frame: Frame): void {
  for (const x of xaxis.tickvals)
    drawLine(context, [crisp(frame.toX(x)), 0, crisp(frame.toX(x)), frame.height], xaxis.gridcolor);
  for (const y of yaxis.tickvals) {
    drawLine(
      context,
      [0, crisp(frame.toY(y)), frame.width, crisp(frame.toY(y))],
      y === 0 ? yaxis.zerolinecolor : yaxis.gridcolor,
    );
  }
}

/** A line of one pixel lies on one. */
const crisp = (at: number) => Math.round(at - 0.5) + 0.5;

function drawLabels(
  context: CanvasRenderingContext2D,
  { layout: { xaxis, yaxis } }: PanelFigure,
  frame: Frame,
  family: string,
): void {
  context.font = `${TICK_PX}px ${family}`;
  context.fillStyle = xaxis.color;
  context.textBaseline = "alphabetic";
  context.textAlign = "center";
  xaxis.tickvals.forEach((x, index) => {
    const text = xaxis.ticktext[index] ?? "";
    const last = frame.width + MARGIN.r - context.measureText(text).width / 2; // or the canvas would cut it
    context.fillText(text, Math.min(frame.toX(x), last), frame.height + TICK_PX + 1);
  });
  context.textAlign = "right";
  yaxis.tickvals.forEach((y, index) =>
    context.fillText(yaxis.ticktext[index] ?? "", -2, frame.toY(y) + 0.36 * TICK_PX),
  );
}

/** `ratio` is how many of its pixels are one of the page's, in either direction. The page is not asked for its style: that would have it styled anew for each panel. */
export function drawOnCanvas(
  canvas: HTMLCanvasElement,
  figure: PanelFigure,
  size: Size,
  ratio: number,
  fontFamily: string,
): void {
  const [wide, high] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
  if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
  const context = canvas.getContext("2d");
  if (!context) return;
  const { xaxis, yaxis, shapes } = figure.layout;
  const [width, height] = [size.width - MARGIN.l - MARGIN.r, size.height - MARGIN.t - MARGIN.b];
  const [perX, perY] = [width / (xaxis.range[1] - xaxis.range[0]), height / (yaxis.range[1] - yaxis.range[0])];
  const frame: Frame = {
    toX: (x) => (x - xaxis.range[0]) * perX,
    toY: (y) => height - (y - yaxis.range[0]) * perY,
    width,
    height,
  };
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, size.width, size.height);
  context.save();
  context.translate(MARGIN.l, MARGIN.t);
  drawLabels(context, figure, frame, fontFamily);
  context.beginPath();
  context.rect(0, 0, width, height);
  context.clip();
  for (const shape of shapes) drawShape(context, shape, frame);
  drawGrid(context, figure, frame);
  figure.data.forEach((trace, index) => {
    const before = figure.data[index - 1];
    if (trace.fill && before) fillBetween(context, trace, before, frame);
    drawTrace(context, trace, frame);
  });
  context.restore();
}
