import { describe, expect, it } from "vitest";
import type { Trial } from "../../api/types";
import { frontFigure, historyFigure, rangeOf } from "./charts";

const palette = { text: "#000", grid: "#111", zero: "#222" };
const shown = { label: "Load", unit: "kN", scale: 1e-3 };
const plain = { label: "Sum", unit: "1", scale: 1 };
const trial = (number: number, values: number[] | null, feasible = true): Trial => ({
  number,
  generation: 0,
  weights: {},
  status: values ? "ok" : "failed",
  reason: null,
  feasible,
  values,
  limits: null,
});

describe("an axis", () => {
  it("shows all that matters and not what is far worse", () => {
    const [low, high] = rangeOf([1, 2], [1.5, 900]);
    expect(low).toBeLessThan(1);
    expect(high).toBeGreaterThan(2);
    expect(high).toBeLessThan(4);
  });

  it("has a size where all values are one", () => {
    const [low, high] = rangeOf([3], []);
    expect(low).toBeLessThan(3);
    expect(high).toBeGreaterThan(3);
  });
});

describe("the front", () => {
  const trials = [
    trial(0, [2, 4000]),
    trial(1, [1, 6000]),
    trial(2, [3, 3000]),
    trial(3, null),
    trial(4, [0.5, 1000], false),
  ];
  const figure = frontFigure({
    trials,
    front: [trials[2], trials[0], trials[1]].filter((each) => each !== undefined),
    named: [],
    picked: 1,
    x: 0,
    y: 1,
    objectives: [plain, shown],
    palette,
    colour: "red",
  });
  const trace = (name: string) => figure.data.filter((each) => each.name === name);

  it("is joined in the order of its first objective, in shown units", () => {
    const line = trace("Front").find((each) => "mode" in each && each.mode === "lines");
    expect([line?.x, line?.y]).toEqual([
      [1, 2, 3],
      [6, 4, 3],
    ]);
  });

  it("sets apart what is over a limit and leaves out what failed", () => {
    expect(trace("Over a limit")[0]?.x).toEqual([0.5]);
    expect(trace("Trials")[0]?.x).toEqual([2, 1, 3]);
    expect(trace("Picked")[0]?.x).toEqual([1]);
  });
});

describe("one objective", () => {
  it("is the best so far over the trials, the paper's beside", () => {
    const paper = trial(0, [2]);
    const trials = [paper, trial(1, [1], false), trial(2, [1.5]), trial(3, null), trial(4, [1.7]), trial(5, [500])];
    const figure = historyFigure({ trials, paper, first: "", picked: null, shown: plain, palette, colour: "red" });
    const line = figure.data.find(({ name }) => name === "Best so far");
    expect([line?.x, line?.y]).toEqual([
      [0, 2, 5],
      [2, 1.5, 1.5],
    ]);
    expect(figure.beyond).toBe(1);
    expect(figure.layout.shapes).toEqual([expect.objectContaining({ y0: 2, y1: 2 })]);
  });
});
