/** The canvas of a sweep with many runs, and what it says of the point under the pointer. */

import { useEffect, useEffectEvent, useRef, useState, type RefObject } from "react";
import type { PlotElement } from "../../plots/plotly";
import plots from "../../plots/plots.module.css";
import classes from "./sweep.module.css";
import type { Dots } from "./scatter";
import { outlineOf } from "../../plots/markers";

interface Props {
  /** Where plotly has drawn the axes. */
  readonly host: RefObject<HTMLDivElement | null>;
  /** Counts plotly's drawings: a new one means new axes. */
  readonly drawing: number;
  readonly dots: readonly Dots[];
  readonly width: number;
  readonly height: number;
  /** What a row says of itself, line by line. */
  readonly textOf: (row: number) => readonly string[];
  readonly onOpen: (row: number) => void;
  /** It cannot be told where plotly's axes lie: the points have to be plotly's own. */
  readonly onNoAxes: () => void;
}

const REACH_PX = 12;
/** Further is a drag, which zooms. */
const CLICK_PX = 4;

export function DotLayer({ host, drawing, dots, width, height, textOf, onOpen, onNoAxes }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawn = useRef<{ readonly located: readonly LocatedDots[]; readonly axes: Axes } | null>(null);
  const [hit, setHit] = useState<Hit | null>(null);

  // Other dots come with a new drawing: before it they would lie on axes of the last.
  const paint = useEffectEvent((element: PlotElement) => {
    if (!canvas.current) return;
    setHit(null);
    const axes = dots.length === 0 ? null : drawnAxes(element);
    if (!axes) {
      drawn.current = null;
      clearDots(canvas.current);
      if (dots.length > 0) onNoAxes();
      return;
    }
    const located = locate(dots, axes);
    drawn.current = { located, axes };
    drawDots(canvas.current, located, axes, { width, height }, () => drawn.current?.located === located);
  });
  useEffect(() => {
    const element = host.current as PlotElement | null;
    if (drawing === 0 || !element) return undefined;
    paint(element);
    element.on("plotly_relayout", () => paint(element));
    return () => element.removeAllListeners?.("plotly_relayout");
  }, [host, drawing]);

  const open = useEffectEvent((row: number) => onOpen(row));
  useEffect(() => {
    const element = host.current;
    if (!element) return undefined;
    let pressed: readonly [number, number] | null = null;
    const find = (event: PointerEvent) => {
      const box = element.getBoundingClientRect();
      return (
        drawn.current &&
        nearest(drawn.current.located, drawn.current.axes, event.clientX - box.left, event.clientY - box.top, REACH_PX)
      );
    };
    const move = (event: PointerEvent) => setHit(event.buttons === 0 ? find(event) : null);
    const leave = () => setHit(null);
    const press = (event: PointerEvent) => {
      pressed = event.button === 0 ? [event.clientX, event.clientY] : null;
    };
    // On the window: plotly covers the page while a button is down.
    const release = (event: PointerEvent) => {
      const near = pressed !== null && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < CLICK_PX;
      pressed = null;
      const row = near ? find(event) : null;
      if (row) open(row.dots.rows[row.index] ?? 0);
    };
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerleave", leave);
    element.addEventListener("pointerdown", press, true);
    window.addEventListener("pointerup", release, true);
    return () => {
      element.removeEventListener("pointermove", move);
      element.removeEventListener("pointerleave", leave);
      element.removeEventListener("pointerdown", press, true);
      window.removeEventListener("pointerup", release, true);
    };
  }, [host]);

  const row = hit?.dots.rows[hit.index];
  return (
    <>
      <canvas ref={canvas} className={plots.canvas} aria-hidden />
      {hit && row !== undefined && (
        <div
          className={classes.tip}
          data-left={hit.x > width / 2 || undefined}
          style={{ left: hit.x, top: hit.y }}
          aria-hidden
        >
          <span className={classes.tipRing} style={{ borderColor: hit.dots.colour }} />
          <span className={classes.tipText} data-testid="tip">
            {textOf(row).map((line) => (
              <span key={line}>{line}</span>
            ))}
          </span>
        </div>
      )}
    </>
  );
}

/** The part of plotly's axis that says where a value lies. */
interface DrawnAxis {
  /** [px] from the figure's edge. */
  readonly _offset: number;
  readonly _length: number;
  readonly d2p: (value: number | string) => number;
}

interface Axes {
  readonly xaxis: DrawnAxis;
  readonly yaxis: DrawnAxis;
}

const isDrawnAxis = (axis: Partial<DrawnAxis> | undefined) =>
  typeof axis?._offset === "number" && typeof axis._length === "number" && typeof axis.d2p === "function";

/** The axes plotly has drawn in an element. They are no part of its documented interface: `null` where a version of it has others. */
export function drawnAxes(element: HTMLElement): Axes | null {
  const { _fullLayout: layout } = element as { readonly _fullLayout?: Partial<Axes> };
  return layout && isDrawnAxis(layout.xaxis) && isDrawnAxis(layout.yaxis) ? (layout as Axes) : null;
}

interface LocatedDots {
  readonly dots: Dots;
  /** [px] from the figure's corner. */
  readonly x: Float32Array;
  readonly y: Float32Array;
}

interface Hit {
  readonly dots: Dots;
  readonly index: number;
  readonly x: number;
  readonly y: number;
}

const HALF = 2.5;

export function locate(all: readonly Dots[], { xaxis, yaxis }: Axes): readonly LocatedDots[] {
  return all.map((dots) => ({
    dots,
    x: Float32Array.from(dots.x, (value) => xaxis._offset + xaxis.d2p(value)),
    y: Float32Array.from(dots.y, (value) => yaxis._offset + yaxis.d2p(value)),
  }));
}

const inside = ({ xaxis, yaxis }: Axes, x: number, y: number) =>
  x >= xaxis._offset && x <= xaxis._offset + xaxis._length && y >= yaxis._offset && y <= yaxis._offset + yaxis._length;

/** The nearest point within reach that is in sight; of points one upon the other, the one drawn last. */
export function nearest(located: readonly LocatedDots[], axes: Axes, x: number, y: number, radius: number): Hit | null {
  let nearest: Hit | null = null;
  let least = radius * radius;
  for (const { dots, x: xs, y: ys } of located) {
    for (let index = 0; index < xs.length; index++) {
      const [atX = NaN, atY = NaN] = [xs[index], ys[index]];
      const distance = (atX - x) ** 2 + (atY - y) ** 2;
      if (distance > least || !inside(axes, atX, atY)) continue;
      least = distance;
      nearest = { dots, index, x: atX, y: atY };
    }
  }
  return nearest;
}

/** One symbol, drawn once and then copied. */
function stamp({ colour, symbol }: Dots, hollow: boolean, ratio: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = Math.ceil((2 * HALF + 4) * ratio);
  const context = canvas.getContext("2d");
  if (!context) return canvas;
  context.scale(ratio, ratio);
  context.translate(HALF + 2, HALF + 2);
  context.globalAlpha = 0.75;
  const outline = new Path2D(outlineOf(symbol, HALF));
  if (hollow) {
    context.strokeStyle = colour;
    context.stroke(outline);
  } else {
    context.fillStyle = colour;
    context.fill(outline);
  }
  return canvas;
}

function clearDots(canvas: HTMLCanvasElement): void {
  canvas.getContext("2d")?.clearRect(0, 0, canvas.width, canvas.height);
}

/** In one task, of some milliseconds. */
const AT_ONCE = 2500;

/** In pieces, until they are no longer wanted. */
function drawDots(
  canvas: HTMLCanvasElement,
  located: readonly LocatedDots[],
  { xaxis, yaxis }: Axes,
  { width, height }: { readonly width: number; readonly height: number },
  areWanted: () => boolean,
): void {
  const ratio = window.devicePixelRatio;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context) return;
  context.beginPath();
  context.rect(xaxis._offset * ratio, yaxis._offset * ratio, xaxis._length * ratio, yaxis._length * ratio);
  context.clip();
  const pieces = located.flatMap(({ dots, x, y }) => {
    const [full, hollow] = [stamp(dots, false, ratio), stamp(dots, true, ratio)];
    const shift = full.width / 2;
    return Array.from({ length: Math.ceil(x.length / AT_ONCE) }, (_, piece) => () => {
      for (let index = AT_ONCE * piece; index < Math.min(AT_ONCE * (piece + 1), x.length); index++) {
        context.drawImage(
          dots.hollow[index] === true ? hollow : full,
          (x[index] ?? 0) * ratio - shift,
          (y[index] ?? 0) * ratio - shift,
        );
      }
    });
  });
  const draw = (piece: number) => {
    if (!areWanted()) return;
    pieces[piece]?.();
    if (piece + 1 < pieces.length) setTimeout(() => draw(piece + 1));
  };
  draw(0);
}
