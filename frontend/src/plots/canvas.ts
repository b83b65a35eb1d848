/** Draws a panel's curves and shapes on a canvas over plotly's axes: fast enough to follow a slider. */

import type { Numbers, PanelFigure, PlotTrace } from "./plotly";
import type { Shape } from "./shapes";
import { MARGIN } from "./figure";

export interface Size {
  readonly width: number;
  readonly height: number;
}

type Range = readonly [number, number];

interface Frame {
  readonly toX: (x: number) => number;
  readonly toY: (y: number) => number;
  readonly width: number;
  readonly height: number;
}

const AT_LEAST_PX = 3;

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
  const across = (value: unknown) => (shape.xref === "paper" ? asNumber(value, 0) * frame.width : frame.toX(asNumber(value, 0)));
  const up = (value: unknown) => (shape.yref === "paper" ? (1 - asNumber(value, 0)) * frame.height : frame.toY(asNumber(value, 0)));
  const [left, right, bottom, top] = [across(shape.x0), across(shape.x1), up(shape.y0), up(shape.y1)];
  context.globalAlpha = asNumber(shape.opacity, 1);
  if (shape.type === "line") {
    const line = shape.line as Readonly<Record<string, unknown>>;
    context.strokeStyle = asText(line.color, "#868e96");
    context.lineWidth = asNumber(line.width, 1);
    context.setLineDash(dashOf(line.dash, context.lineWidth));
    context.beginPath();
    context.moveTo(left, bottom);
    context.lineTo(right, top);
    context.stroke();
  } else {
    context.fillStyle = asText(shape.fillcolor, "transparent");
    context.fillRect(left, top, right - left, bottom - top);
  }
  context.globalAlpha = 1;
}

function tracePath(context: CanvasRenderingContext2D, x: Numbers, y: Numbers, frame: Frame): void {
  context.beginPath();
  for (let i = 0; i < x.length; i++) context.lineTo(frame.toX(x[i] ?? 0), frame.toY(y[i] ?? 0));
  context.stroke();
}

function drawTrace(context: CanvasRenderingContext2D, { x, y, line, opacity = 1 }: PlotTrace, frame: Frame): void {
  context.globalAlpha = opacity;
  context.strokeStyle = asText(line.color, "#868e96");
  context.lineWidth = asNumber(line.width, 1.5);
  context.lineJoin = "round";
  context.setLineDash(dashOf(line.dash, context.lineWidth));
  tracePath(context, x, y, frame);
  context.globalAlpha = 1;
}

export function clearCanvas(canvas: HTMLCanvasElement): void {
  canvas.getContext("2d")?.clearRect(0, 0, canvas.width, canvas.height);
}

/** Draws the figure into the plot area that plotly's axes leave, for an x and a y range. */
export function drawOnCanvas(canvas: HTMLCanvasElement, { data, layout }: PanelFigure, size: Size, xRange: Range, yRange: Range): void {
  const ratio = window.devicePixelRatio;
  const [wide, high] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
  if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
  const context = canvas.getContext("2d");
  if (!context) return;
  const [width, height] = [size.width - MARGIN.l - MARGIN.r, size.height - MARGIN.t - MARGIN.b];
  const [perX, perY] = [width / (xRange[1] - xRange[0]), height / (yRange[1] - yRange[0])];
  const frame: Frame = { toX: (x) => (x - xRange[0]) * perX, toY: (y) => height - (y - yRange[0]) * perY, width, height };
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, size.width, size.height);
  context.save();
  context.translate(MARGIN.l, MARGIN.t);
  context.beginPath();
  context.rect(0, 0, width, height);
  context.clip();
  for (const shape of layout.shapes) drawShape(context, shape, frame);
  for (const trace of data) drawTrace(context, trace, frame);
  context.restore();
}
