import { expect, it } from "vitest";
import { enlarged } from "./EnlargedFigure";
import { ON_PAPER } from "./palettes";
import { loadPanel } from "./template.fixture";

const template = loadPanel({ lv: "LV <b>" }, { axes: { position: "Distance [m]" } });
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
