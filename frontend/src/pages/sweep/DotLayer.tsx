/** The canvas of a sweep with many runs, and what it says of the point under the pointer. */

import { useEffect, useEffectEvent, useRef, useState, type RefObject } from "react";
import type { PlotElement } from "../../plots/plotly";
import plots from "../../plots/plots.module.css";
import classes from "./sweep.module.css";
import { clearDots, drawDots, drawnAxes, nearest, locate, type Axes, type Hit, type LocatedDots } from "./dots";
import type { Dots } from "./scatter";

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
