/** Pointer, cursor line and zoom brush over one panel. The lines move without React: they follow every frame. */

import { useEffect, useRef, type PointerEvent } from "react";
import { runAction } from "../lab/actions";
import { cursor } from "../lab/cursor";
import { createTimer } from "../lib/timer";
import type { Axis, Zoom } from "../lab/address";
import { MARGIN } from "./figure";
import classes from "./plots.module.css";
import { createAtom } from "@tanstack/react-store";

interface Props {
  readonly axis: Axis;
  readonly range: Zoom;
  readonly onZoom: (zoom: Zoom | null) => void;
}

/** Shorter drags are clicks. */
const LEAST_DRAG_PX = 6;

export function Overlay({ axis, range, onZoom }: Props) {
  const area = useRef<HTMLDivElement>(null);
  const line = useRef<HTMLDivElement>(null);
  const band = useRef<HTMLDivElement>(null);
  const [low, high] = range;

  useEffect(() => {
    const percent = (x: number) => `${((x - low) / (high - low)) * 100}%`;
    const drawLine = () => {
      const x = cursor.get(axis);
      if (!line.current) return;
      const visible = x !== null && x >= low && x <= high;
      line.current.style.display = visible ? "block" : "none";
      if (visible) line.current.style.left = percent(x);
    };
    const drawBand = () => {
      const stretch = brush.get();
      if (!band.current) return;
      band.current.style.display = stretch ? "block" : "none";
      if (!stretch) return;
      const [from, to] = [Math.min(stretch.from, stretch.to), Math.max(stretch.from, stretch.to)];
      band.current.style.left = percent(from);
      band.current.style.width = `${((to - from) / (high - low)) * 100}%`;
    };
    drawLine();
    drawBand();
    const stops = [cursor.subscribe(drawLine), brush.subscribe(drawBand)];
    return () => {
      for (const stop of stops) stop.unsubscribe();
    };
  }, [axis, low, high]);

  const positionOf = (event: PointerEvent) => {
    const box = area.current?.getBoundingClientRect();
    if (!box || box.width === 0) return low;
    const part = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    return low + part * (high - low);
  };
  const widthOf = (stretch: { from: number; to: number }) =>
    (Math.abs(stretch.to - stretch.from) / (high - low)) * (area.current?.clientWidth ?? 0);

  return (
    <div
      ref={area}
      role="presentation" // the cursor has a slider under the car, the zoom its buttons
      className={classes.overlay}
      style={{ inset: `${MARGIN.t}px ${MARGIN.r}px ${MARGIN.b}px ${MARGIN.l}px` }}
      onPointerDown={(event) => {
        cursor.set(axis, positionOf(event));
        if (event.pointerType !== "mouse" || event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        brush.set({ from: positionOf(event), to: positionOf(event) });
      }}
      onPointerMove={(event) => {
        cursor.set(axis, positionOf(event));
        const stretch = brush.get();
        if (stretch) brush.set({ ...stretch, to: positionOf(event) });
      }}
      onPointerUp={() => {
        const stretch = brush.get();
        brush.set(null);
        if (!stretch) return;
        if (widthOf(stretch) < LEAST_DRAG_PX) {
          click.start();
          return;
        }
        onZoom([Math.min(stretch.from, stretch.to), Math.max(stretch.from, stretch.to)]);
      }}
      onPointerCancel={() => brush.set(null)}
      onDoubleClick={() => {
        click.stop();
        onZoom(null);
      }}
    >
      <div ref={band} className={classes.brush} />
      <div ref={line} className={classes.cursor} />
    </div>
  );
}

/** A second click within this makes it a double click [ms]. */
const DOUBLE_CLICK_MS = 250;

/** One click looks at the instant under the cursor. */
const click = createTimer(DOUBLE_CLICK_MS, () => runAction("instant"));

/** The stretch being drawn with the pointer to zoom into; all panels show it. */
interface Brush {
  readonly from: number;
  readonly to: number;
}

const brush = createAtom<Brush | null>(null);
