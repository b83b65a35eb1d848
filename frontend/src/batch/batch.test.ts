import { describe, expect, it } from "vitest";
import { secondsLeft, withMark, type Mark } from "./pace";
import { lowest, ordered, pointsOf, rowsOf, scenarioOf, type Columns } from "./table";

const COLUMNS: Columns = {
  run: [0, 1, 2, 3],
  strategy: ["lv", "passive", "lv", "passive"],
  status: ["ok", "ok", "failed", "ok"],
  "road.bump.height": [0.1, 0.1, 0.05, 0.05],
  "mpc.stage_weights.cruise.0": [8, 8, 2, 2],
  peak: [0.9, 6.2, null, 3.1],
};

describe("rows", () => {
  it("are sorted by any column, what has no value last", () => {
    expect(ordered(COLUMNS, [0, 1, 2, 3], { column: "peak", descending: false })).toEqual([0, 3, 1, 2]);
    expect(ordered(COLUMNS, [0, 1, 2, 3], { column: "peak", descending: true })).toEqual([1, 3, 0, 2]);
    expect(ordered(COLUMNS, [0, 1, 2, 3], { column: "strategy", descending: false })).toEqual([0, 2, 1, 3]);
  });

  it("can be kept by what they are", () => {
    expect(rowsOf(COLUMNS, (row) => COLUMNS.status?.[row] === "failed")).toEqual([2]);
    expect(rowsOf({}, () => true)).toEqual([]);
  });

  it("have a best one, unless none has a value", () => {
    expect(lowest(COLUMNS, [1, 2, 3], "peak")).toBe(3);
    expect(lowest(COLUMNS, [2], "peak")).toBeNull();
  });

  it("are scenarios", () => {
    const base = { road: { bump: { height: 1, width: 4 } }, mpc: { stage_weights: { cruise: [1, 1, 1] } } };
    expect(scenarioOf(base, COLUMNS, ["road.bump.height", "mpc.stage_weights.cruise.0"], 2)).toEqual({
      road: { bump: { height: 0.05, width: 4 } },
      mpc: { stage_weights: { cruise: [2, 1, 1] } },
    });
  });

  it("are points in the order of x, without those that failed", () => {
    expect(pointsOf(COLUMNS, ["passive", "lv"], "road.bump.height", "peak", 10)).toEqual([
      { strategy: "passive", rows: [3, 1], x: [0.05, 0.1], y: [31, 62] },
      { strategy: "lv", rows: [0], x: [0.1], y: [9] },
    ]);
  });
});

describe("time left", () => {
  const marks = (...list: readonly (readonly [number, number])[]) =>
    list.reduce<readonly Mark[]>((all, [at, finished]) => withMark(all, { at, finished }), []);

  it("follows the pace", () => {
    expect(secondsLeft(marks([0, 0], [2000, 20]), 100)).toBe(8);
  });

  it("is unknown at first and while nothing moves", () => {
    expect(secondsLeft(marks([0, 0]), 100)).toBeNull();
    expect(secondsLeft(marks([0, 0], [100, 5]), 100)).toBeNull();
    expect(secondsLeft(marks([0, 5], [9000, 5]), 100)).toBeNull();
  });

  it("forgets a pace that is over", () => {
    const kept = marks([0, 0], [10_000, 1000], [60_000, 1100], [80_000, 1300]);
    expect(kept[0]).toEqual({ at: 60_000, finished: 1100 });
    expect(secondsLeft(kept, 1500)).toBe(20);
  });
});
