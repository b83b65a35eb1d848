import { expect, it, test } from "vitest";
import type { JsonObject } from "../api/types";
import { paperScenarioOf } from "./differences";
import { FORM } from "./form.fixture";
import { setAt } from "./path";
import { onRoad, withItem } from "./withItem";

const PAPER = { road: { profile: null, length: 150, seed: 1, bump: { height: 0.1, width: 4, start: 100, count: 3 } } };
const ROAD = { id: "A".repeat(22), length: 180, bumps: [] };

test.each([180, 60])(
  "a measured road without a bump has none, and ends where what was measured does: %d m",
  (length) => {
    const road = { ...PAPER.road, profile: ROAD.id, length, bump: { ...PAPER.road.bump, height: 0, start: length } };
    expect(onRoad(PAPER, { ...ROAD, length })).toEqual({ road });
  },
);

test("a bump that was found is the one the car brakes for, and none is added", () => {
  const measured = { ...ROAD, bumps: [{ start: 0.4, width: 200, height: 0.07 }] };
  expect(onRoad(PAPER, measured).road).toMatchObject({ bump: { start: 1, width: 179, height: 0, count: 1 } });
});

const paper = paperScenarioOf(FORM);

it("A saved scenario takes the paper's value for a field that is newer, and loses one that is gone", () => {
  const saved: JsonObject = { road: { bump: { height: 0.2 }, colour: 3 }, mpc: { lag: 5 } };
  expect(withItem({}, { kind: "scenario", value: saved }, FORM)).toEqual(
    setAt(setAt(paper, "/road/bump/height", 0.2), "/mpc/lag", 5),
  );
});

it("A saved road is driven to its end; the rest of the scenario stays", () => {
  const edited = setAt(paper, "/mpc/lag", 5);
  const opened = withItem(edited, { kind: "road", value: { id: "r", length: 80, bumps: [] } }, FORM);
  const road = { profile: "r", length: 80, "bump/height": 0, "bump/start": 80 };
  const changed = Object.entries(road).reduce((result, [name, value]) => setAt(result, `/road/${name}`, value), edited);
  expect(opened).toEqual(changed);
});
