/** The torque over both inputs, and the drive on it. */

import type { FuzzyAnswer } from "../../api/types";
import type { ResultView } from "../../lab/resultView";
import { extent } from "../../lib/samples";
import { chartLayout, type Palette } from "../../plots/palettes";
import type { ChartFigure } from "../../plots/Chart";
import { numberAt } from "../../scenario/path";

interface Driven {
  readonly label: string;
  /** To the bump [m], and above the target speed [km/h]. */
  readonly distance: readonly number[];
  readonly speedError: readonly number[];
}

const KMH = 3.6;

/** The first strategy that slows down, from where the bump is detected to where it begins. */
export function drivenIn({ shown, strategies, series }: ResultView): Driven | null {
  const bump = numberAt(shown.scenario, "/road/bump/start", 0);
  const target = numberAt(shown.scenario, "/speed/target_speed_kmh", 0);
  const detected = bump - numberAt(shown.scenario, "/speed/detection_distance", 0);
  for (const { id, label } of strategies) {
    const { position, speed } = series[id] ?? {};
    const [slowest = 0, fastest = 0] = (speed && extent(speed)) ?? [];
    if (!position || !speed || fastest - slowest < 0.1) continue;
    const places = Array.from(position.keys()).filter((at) => {
      const x = position[at] ?? 0;
      return x >= detected && x <= bump;
    });
    const distance = places.map((at) => bump - (position[at] ?? 0));
    return { label, distance, speedError: places.map((at) => KMH * (speed[at] ?? 0) - target) };
  }
  return null;
}

export function surfaceFigure(
  { surface, speed_error, distance }: FuzzyAnswer,
  driven: Driven | null,
  palette: Palette,
): ChartFigure {
  const columns = surface.speed_error.map((_, at) => surface.torque.map((row) => row[at] ?? 0));
  const line = { mode: "lines", opacity: 1, hoverinfo: "skip", type: "scatter", name: "" } as const;
  const path = { ...line, x: driven?.distance ?? [], y: driven?.speedError ?? [] };
  return {
    data: [
      {
        type: "contour",
        name: "",
        x: surface.distance,
        y: surface.speed_error,
        z: columns,
        zmin: 0,
        zmax: 1,
        autocontour: false,
        contours: { start: 0.1, end: 0.9, size: 0.1, coloring: "heatmap" },
        line: { width: 0.6, color: "#ffffff" },
        colorscale: "Cividis",
        colorbar: { thickness: 10, outlinewidth: 0, tickformat: ".0%" },
        hovertemplate: "%{x:.0f} m, %{y:.0f} km/h: %{z:.0%}<extra></extra>",
      },
      // A light line below a dark one is seen on every colour.
      { ...path, line: { width: 5, color: "#ffffff" } },
      { ...path, line: { width: 2, color: "#101418" } },
    ],
    layout: chartLayout(palette, {
      margin: { l: 44, r: 8, t: 12, b: 40 },
      xaxis: { title: { text: `Distance to the bump [${distance.unit}]` }, range: [distance.universe.at(-1), 0] },
      yaxis: { title: { text: `Speed error [${speed_error.unit}]` }, range: [0, speed_error.universe.at(-1)] },
    }),
  };
}
