/** Plays the cursor along the run, at a part of real time. */

import { valueAt } from "../../lib/samples";
import { cursor } from "../../lab/cursor";
import type { Scene } from "../../lab/resultView";
import { restingCursor } from "./resting";

/** Where the cursor is after `elapsed` seconds of the run, for one strategy; starts over past the range's end. */
function advance(scene: Scene, strategy: string, from: number, elapsed: number): number {
  const series = scene.series[strategy];
  const [low, high] = scene.range;
  if (from >= high || from < low) return low;
  if (scene.axis === "time") return Math.min(high, from + elapsed);
  const { position, time } = series ?? {};
  if (!position || !time) return from;
  const now = valueAt(position, time, from);
  const next = now === null ? null : valueAt(time, position, now + elapsed);
  return next === null ? high : Math.min(high, next);
}

/** Runs until the returned function is called; `scene` is asked anew for every frame. */
export function play(scene: () => Scene, strategy: () => string, speed: () => number): () => void {
  let frame = 0;
  let last = performance.now();
  const step = (now: number) => {
    const elapsed = Math.min(0.1, (now - last) / 1000) * speed();
    last = now;
    const current = scene();
    cursor.set(current.axis, advance(current, strategy(), cursor.get(current.axis) ?? restingCursor(current), elapsed));
    frame = requestAnimationFrame(step);
  };
  frame = requestAnimationFrame(step);
  return () => cancelAnimationFrame(frame);
}
