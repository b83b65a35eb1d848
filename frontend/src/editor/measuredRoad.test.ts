import { expect, test } from "vitest";
import { onRoad } from "./measuredRoad";

const PAPER = { road: { profile: null, length: 150, seed: 1, bump: { height: 0.1, width: 4, start: 100, count: 3 } } };
const ROAD = { id: "A".repeat(22), length: 180, bumps: [] };

test("the road ends where what was measured does; the scenario's own bump stays and is added", () => {
  expect(onRoad(PAPER, ROAD)).toEqual({ road: { ...PAPER.road, profile: ROAD.id, length: 180 } });
});

test("a bump that was found is the one the car brakes for, and none is added", () => {
  const found = { ...ROAD, bumps: [{ start: 0.4, width: 200, height: 0.07 }] };
  expect(onRoad(PAPER, found).road).toMatchObject({ bump: { start: 1, width: 179, height: 0, count: 1 } });
});
