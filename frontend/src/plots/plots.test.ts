import { describe, expect, it } from "vitest";
import { maximumOf, minimumOf } from "../api/decode";
import type { Summary } from "../api/types";
import { drawOnCanvas, keepsRange } from "./Surface";
import { buildFigure, MARGIN, ticksFor } from "./figure";
import type { FigureInput } from "./curves";
import { loadPlotly, plotlyState, type Plotly } from "./plotly";
import { stageShapes } from "./shapes";
import { loadPanel } from "./template.fixture";
import CASE from "../../../tests/data/stage_shapes.json";
import { covering, extent, stretchesBelow, valueAt } from "../lib/samples";

const X = new Float32Array([0, 1, 2, 3, 4]);
const LOAD = new Float32Array([0, -6000, -7000, 2000, 0]);

describe("samples", () => {
  it("are interpolated, and nothing beyond their ends", () => {
    expect(valueAt(X, LOAD, 0.5)).toBe(-3000);
    expect(valueAt(X, LOAD, 3)).toBe(2000);
    expect(valueAt(X, LOAD, 4.1)).toBeNull();
    expect(valueAt(new Float32Array(), new Float32Array(), 0)).toBeNull();
  });

  it("have no value where a recorded drive lacks the signal or has a gap", () => {
    expect(valueAt(X, new Float32Array(5).fill(NaN), 2)).toBeNull();
    const gap = new Float32Array([NaN, 1, NaN, 3, 4]);
    expect([0, 0.5, 1, 1.5, 2, 3.5].map((x) => valueAt(X, gap, x))).toEqual([null, null, 1, null, null, 3.5]);
  });

  it("are cut with one neighbour on each side", () => {
    expect(covering(X, 1.5, 2.5)).toEqual([1, 4]);
    expect(covering(X, -5, 9)).toEqual([0, 5]);
  });

  it("know their extent and where they lie too low", () => {
    expect(extent(LOAD)).toEqual([-7000, 2000]);
    expect(extent(new Float32Array())).toBeNull();
    expect(stretchesBelow(X, LOAD, -5000)).toEqual([[1, 3]]);
    expect(stretchesBelow(X, new Float32Array([0, 0, 0, 0, -9]), -5)).toEqual([[4, 4]]);
  });
});

const template = loadPanel(
  { lv: "LV", passive: "Passive" },
  {
    stage_fills: { bump: "rgba(0, 0, 255, 0.1)" },
    braking: 20_000,
    axes: {},
    reference_factors: { front_static_load: [-1] },
  },
);
const summary = {
  reference: { front_static_load: 5000 },
  stages: [
    { stage: "cruise", start_time: 0, end_time: 1, start_position: 0, end_position: 1 },
    { stage: "bump", start_time: 1, end_time: 2, start_position: 1, end_position: 2.5 },
  ],
} as unknown as Summary;
const input: FigureInput = {
  template,
  series: { lv: { position: X, time: X, load: LOAD } },
  sourceSeries: {},
  summaries: { lv: summary },
  strategies: [
    { id: "lv", colour: "#123456" },
    { id: "passive", colour: "#666" },
  ],
  axis: "distance",
  range: [0, 4],
  palette: { text: "#000", grid: "#eee", zero: "#ccc" },
};

describe("a filled figure", () => {
  it("draws only what has data, in the shown unit", () => {
    const { data } = buildFigure(input);
    expect(data).toHaveLength(1);
    expect(data[0]?.y[2]).toBe(-7);
    expect(data[0]?.line.color).toBe("#123456"); // the strategy's, which follows the scheme
  });

  it("fades every curve but the one that stands out, and draws the state before in grey", () => {
    const series = { ...input.series, passive: { position: X, time: X, load: LOAD } };
    const before = { name: "before", series, line: {}, grey: true, opacity: 0.65 };
    const { data } = buildFigure({ ...input, series, layers: [before], isolated: "lv" });
    expect(data.map(({ opacity }) => opacity)).toEqual([0.65, 0.12, 1, 0.12]);
    expect(data.map(({ line }) => line.color)).toEqual(["#000", "#000", "#123456", "#666"]);
  });

  it("shades the stage, the airborne stretch and the static load", () => {
    const shapes = buildFigure(input).layout.shapes;
    expect(shapes).toContainEqual(expect.objectContaining({ x0: 1, x1: 2.5, yref: "paper" }));
    expect(shapes).toContainEqual(expect.objectContaining({ x0: 1, x1: 3, opacity: expect.any(Number) as number }));
    expect(shapes).toContainEqual(expect.objectContaining({ type: "line", y0: -5, y1: -5 }));
  });

  it("shades by time when over time", () => {
    expect(buildFigure({ ...input, axis: "time" }).layout.shapes).toContainEqual(
      expect.objectContaining({ x0: 1, x1: 2 }),
    );
  });

  it("fits its y axis to what is in the range", () => {
    const [low, high] = buildFigure({ ...input, range: [3.2, 4] }).layout.yaxis.range;
    expect(low).toBeGreaterThan(-1);
    expect(high).toBeGreaterThan(2);
  });
});

describe("a figure over several roads", () => {
  const [low, high] = [LOAD.map((value) => value - 2000), LOAD.map((value) => value + 1000)];
  const own = { position: X, time: X, load: LOAD, [minimumOf("load")]: low, [maximumOf("load")]: high };
  const over = {
    ...input,
    series: { lv: own },
    layers: [{ name: "before the edit", series: { lv: own }, line: {}, opacity: 0.5 }],
  };

  it("has a band from the smallest to the largest value under every curve", () => {
    const { data, layout } = buildFigure(over);
    expect(data.map(({ y }) => y[1])).toEqual([-8, -5, -6, -6]);
    const [bottom, top] = data;
    expect(bottom).toMatchObject({ line: { width: 0 }, showlegend: false });
    expect(bottom).not.toHaveProperty("fill");
    expect(top).toMatchObject({ fill: "tonexty", fillcolor: "#1234563d", showlegend: false });
    expect(layout.yaxis.range[0]).toBeLessThan(-9);
  });

  it("shows where a tyre leaves one of the roads", () => {
    const shapes = buildFigure({ ...over, series: { lv: { ...own, load: LOAD.map((value) => value / 2) } } }).layout
      .shapes;
    expect(shapes).toContainEqual(expect.objectContaining({ x0: 1, x1: 3, opacity: expect.any(Number) as number }));
  });

  it("is filled by the canvas between the two edges, in that colour, no edge is drawn, no label cut", () => {
    let path: (readonly [number, number])[] = [];
    const filled: unknown[] = [];
    const stroked: unknown[] = [];
    const ends: number[] = [];
    const context = new Proxy<Record<string, unknown>>(
      {
        beginPath: () => (path = []),
        lineTo: (x: number, y: number) => path.push([x, y]),
        fill: () => filled.push([context.fillStyle, path]),
        stroke: () => stroked.push(context.strokeStyle),
        measureText: () => ({ width: 40 }),
        fillText: (_text: string, x: number) => ends.push(context.textAlign === "center" ? x + 20 : x),
      },
      { get: (target, name: string) => target[name] ?? (() => undefined) },
    );
    const canvas = { width: 0, height: 0, getContext: () => context } as unknown as HTMLCanvasElement;
    const figure = buildFigure({ ...over, layers: [] });
    drawOnCanvas(canvas, figure, { width: MARGIN.l + MARGIN.r + 400, height: MARGIN.t + MARGIN.b + 100 }, 1, "Arial");
    const [bottom, top] = figure.layout.yaxis.range;
    const toY = (y: number) => expect.closeTo((100 * (top - y)) / (top - bottom), 6) as number;
    expect(filled).toEqual([
      [
        "#1234563d",
        [
          ...[...low].map((y, index) => [100 * index, toY(y / 1000)]),
          ...[...high].map((y, index) => [100 * index, toY(y / 1000)]).reverse(),
        ],
      ],
    ]);
    expect(stroked.filter((colour) => colour === "#123456")).toHaveLength(1);
    expect(Math.max(...ends)).toBe(400 + MARGIN.r);
  });
});

describe("an axis zoomed into stillness", () => {
  it("keeps the run's proportions", () => {
    const still = { position: X, time: X, load: new Float32Array([0, -10_000, 0, 1e-20, 0]) };
    const [low, high] = buildFigure({ ...input, series: { lv: still }, range: [3, 4] }).layout.yaxis.range;
    expect(high - low).toBeGreaterThan(0.1);
    expect(high - low).toBeLessThan(1);
  });
});

describe("the stages", () => {
  const { strategies, shaded } = CASE;
  const series = Object.fromEntries(
    Object.entries(strategies).map(([id, { time, position, brake_pressure: pressure }]) => [
      id,
      {
        time: new Float32Array(time),
        position: new Float32Array(position),
        brake_pressure: new Float32Array(pressure),
      },
    ]),
  );
  const fills = { brake: "orange", bump: "blue" } as const;
  const meta = { ...template.layout.meta, stage_fills: fills };
  const drawn = (axis: "distance" | "time") =>
    stageShapes({
      template: { ...template, layout: { meta } },
      sourceSeries: series,
      summaries: strategies as unknown as FigureInput["summaries"],
      strategies: [
        { id: "passive", colour: "#666" },
        { id: "lv", colour: "#123456" },
      ],
      axis,
    })
      .filter(({ y0 }) => y0 === 0)
      .map(({ fillcolor, x0, x1 }) => [fillcolor, x0, x1]);

  it.each([
    ["distance", shaded.position],
    ["time", shaded.time],
  ] as const)("are shaded over %s by the rule the service has", (axis, expected) => {
    expect(drawn(axis)).toEqual(expected.map(([stage, low, high]) => [fills[stage as "brake" | "bump"], low, high]));
  });
});

it("an axis spans at least what somebody could feel", () => {
  const meta = { ...template.layout.meta, least_span: 10 };
  const [low, high] = buildFigure({ ...input, template: { ...template, layout: { meta } }, range: [3.2, 4] }).layout
    .yaxis.range;
  expect(high - low).toBeGreaterThanOrEqual(10);
});

describe("ticks", () => {
  it("stand at 1, 2 or 5 times a power of ten, the last with the unit", () => {
    expect(ticksFor([95.8, 113.2], 8, " m")).toEqual({ values: [100, 105, 110], texts: ["100", "105", "110 m"] });
    expect(ticksFor([-0.22, 0.31], 6).texts).toEqual(["−0.2", "−0.1", "0", "0.1", "0.2", "0.3"]);
  });
});

it("plotly is asked for again after it could not be loaded, and only then", async () => {
  const plotly = {} as Plotly;
  await expect(loadPlotly(() => Promise.reject(new Error("offline")))).rejects.toThrow("offline");
  expect(plotlyState.get()).toMatchObject({ plotly: null, failed: true });
  expect(await loadPlotly(() => Promise.resolve({ default: plotly }))).toBe(plotly);
  expect(plotlyState.get()).toMatchObject({ plotly, failed: false });
  expect(await loadPlotly(() => Promise.reject(new Error("never called")))).toBe(plotly);
});

describe("the live y axis", () => {
  it("stays while curves fit and fill it", () => {
    expect(keepsRange([-10, 10], [-8, 8])).toBe(true);
    expect(keepsRange([-10, 10], [-2, 2])).toBe(false);
    expect(keepsRange([-10, 10], [-11, 8])).toBe(false);
    expect(keepsRange(null, [0, 1])).toBe(false);
  });
});
