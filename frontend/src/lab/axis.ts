/** From distance to time and back: zoom and cursor stay on the same piece of the run. */

import { valueAt } from "../lib/samples";
import type { Axis, ViewZoom } from "./address";
import { cursor } from "./cursor";
import type { Router } from "./labAddress";
import { axisKey, type Scene } from "./resultView";

export function switchAxis(router: Router, scene: Scene | null, axis: Axis): void {
  const first = scene?.ids[0];
  const series = first === undefined ? undefined : scene?.series[first];
  const from = scene && series?.[axisKey(scene.axis)];
  const to = series?.[axisKey(axis)];
  const convert = (x: number) => (from && to ? valueAt(from, to, x) : null);

  const { zoom } = router.get().view;
  const at = scene && cursor.get(scene.axis);
  cursor.set(axis, at === null ? null : convert(at));
  router.setView({ axis, zoom: converted(zoom, convert) });
}

function converted(zoom: ViewZoom, convert: (x: number) => number | null): ViewZoom {
  if (zoom === "whole" || zoom === null) return zoom;
  const [low, high] = [convert(zoom[0]), convert(zoom[1])];
  return low !== null && high !== null ? [low, high] : null;
}
