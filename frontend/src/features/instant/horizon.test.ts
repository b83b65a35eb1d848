import { describe, expect, it } from "vitest";
import type { InstantAnswer } from "../../api/types";
import { PALETTES } from "../../plots/palettes";
import { horizonFigures, limitName } from "./InstantPanel";

const LIMIT = { unit: "N", distance: 0, multiplier: 0, multipliers: [], values: [], force_without: null };
const PLANNED: InstantAnswer = {
  strategy: "lv",
  ...{ step: 3, time: 2, position: 20, speed: 10, stage: "bump", why: "So." },
  ...{ state: [], estimated_state: null, measurement: [], parts: null, cost: { force: 1 } },
  forces: { asked: [1, 2], command: [1, 2], previous: [0, 0], acting: [1, 2] },
  limits: [
    { ...LIMIT, name: "front_force", limit: 500 },
    { ...LIMIT, name: "front_deflection", unit: "m", limit: 0.08 },
  ],
  predicted_time: [2, 2.5, 3],
  predicted_states: [
    [0.01, -0.02],
    [0.03, -0.04],
    [0.05, -0.06],
  ],
  predicted_forces: [
    [100, -100],
    [200, -200],
  ],
  preview: {
    mode: "lookahead",
    time: [2.5, 3],
    position: [25, 30],
    seen: [
      [0.001, 0],
      [0.002, 0],
    ],
    real: [
      [0.003, 0],
      [0.004, 0],
    ],
  },
};

describe("what is drawn of an instant", () => {
  it("is travel in millimetres, forces held over each step, and the road ahead, over the seconds from now", () => {
    const [travel, forces, road] = horizonFigures(PLANNED, "#123456", PALETTES.light).map(({ figure }) => figure);
    expect(travel?.data.map(({ x, y }) => [...x, ...y].map(Math.round))).toEqual([
      [0, 1, 1, 10, 30, 50],
      [0, 1, 1, -20, -40, -60],
    ]);
    expect(travel?.layout.shapes.map(({ y0 }) => y0)).toEqual([-80, 80]);
    expect([...(forces?.data[1]?.x ?? [])]).toEqual([0, 0.5, 0.5, 1]);
    expect([...(forces?.data[1]?.y ?? [])]).toEqual([-100, -100, -200, -200]);
    expect(road?.data.map(({ y }) => Math.round(y[1] ?? 0))).toEqual([4, 0, 2, 0]);
  });

  it("is nothing of a law that neither plans nor looks ahead", () => {
    const bare = { ...PLANNED, predicted_time: null, predicted_states: null, predicted_forces: null, preview: null };
    expect(horizonFigures(bare, "#123456", PALETTES.light)).toEqual([]);
  });

  it("is named in words", () => {
    expect(["rear_deflection", "front_force_change", "mine"].map(limitName)).toEqual([
      "Rear travel",
      "Front force change in a step",
      "mine",
    ]);
  });
});
