/** A load's panel, for tests. */

import type { FigureTemplate, StrategyId } from "../api/types";

export const loadPanel = (
  names: Readonly<Record<StrategyId, string>>,
  meta: Partial<FigureTemplate["layout"]["meta"]> = {},
): FigureTemplate => ({
  data: Object.entries(names).map(([strategy, name]) => ({
    name,
    meta: { strategy, signal: "load" },
    line: { color: "#1C5FDF" },
  })),
  layout: {
    meta: {
      stage_fills: {},
      band_fill: "grey",
      neutral: "grey",
      title: "Load",
      unit: "kN",
      scale: 1e-3,
      signal: "load",
      least_span: 0,
      braking: 0,
      band: null,
      axes: { position: "Position [m]" },
      reference_labels: {},
      reference_factors: {},
      ...meta,
    },
  },
});
