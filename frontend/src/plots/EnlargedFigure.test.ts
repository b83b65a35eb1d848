import { expect, it } from "vitest";
import type { FigureTemplate } from "../api/types";
import { enlarged } from "./EnlargedFigure";
import { ON_PAPER } from "./palettes";

const template = {
  data: [{ name: "LV <b>", meta: { strategy: "lv", signal: "load" }, line: {} }],
  layout: {
    meta: {
      ...{
        title: "Load",
        unit: "kN",
        scale: 1,
        signal: "load",
        least_span: 0,
        braking: 1,
        stage_fills: {},
        axes: { position: "Distance [m]" },
      },
      ...{ band_fill: "grey", neutral: "grey", band: null, reference_labels: {}, reference_factors: {} },
    },
  },
} as unknown as FigureTemplate;
const lv = { position: new Float32Array([0, 10, 20, 30]), load: new Float32Array([0, 1, 90, 2]) };
const curves = {
  ...{
    series: { lv },
    sourceSeries: { lv },
    summaries: {},
    strategies: [{ id: "lv", label: "LV", colour: "#123456" }] as never,
  },
  ...{ axis: "distance" as const, range: [0, 10] as const, live: false, runId: null, coreVersion: "1" },
};

it("a panel opens on its part of the run and has all of it to pan to; what is typed is no HTML", () => {
  const { data, layout } = enlarged(template, { ...curves, minus: "a<b" }, ON_PAPER);
  expect(data[0]).toMatchObject({ x: lv.position, name: "LV &lt;b>" });
  const { xaxis, yaxis } = layout as unknown as Record<"xaxis" | "yaxis", { range: readonly [number, number] }>;
  expect(xaxis).toMatchObject({ range: [0, 10], title: { text: "Distance [m]" } });
  expect(yaxis).toMatchObject({ title: { text: "Load [kN], change against a&lt;b" } });
});
