import { describe, expect, it } from "vitest";
import { frontOf } from "./scatter";
import { coarse, failing, firstFailure, hatched, lacksStops, mapGrid, shareBelow } from "./map";
import { mapFigure } from "./MapPlot";
import type { GridTrace } from "../../plots/plotly";
import type { Columns } from "../../features/sweep/table";

// Two heights and two speeds; LV's last run has failed.
const COLUMNS: Columns = {
  run: [0, 1, 2, 3, 4, 5, 6, 7],
  strategy: ["lv", "passive", "lv", "passive", "lv", "passive", "lv", "passive"],
  height: [5, 5, 5, 5, 10, 10, 10, 10],
  speed: [20, 20, 40, 40, 20, 20, 40, 40],
  peak: [1, 2, 3, 3, 2, 8, null, 9],
};
const QUESTION = { x: "height", y: "speed", metric: "peak", scale: 10, strategy: "lv", against: null, oneRoadNoise: 0 };

describe("a map", () => {
  it("has a cell for each pair of values, and a gap where there is none", () => {
    expect(mapGrid(COLUMNS, QUESTION)).toEqual({
      xs: [5, 10],
      ys: [20, 40],
      values: [
        [10, 20],
        [30, null],
      ],
      halves: [
        [0, 0],
        [0, 0],
      ],
      unsettled: [
        [false, false],
        [false, false],
      ],
      rows: [
        [[0], [4]],
        [[2], [6]],
      ],
    });
  });

  it("of a difference is the change in percent", () => {
    const grid = mapGrid(COLUMNS, { ...QUESTION, against: "passive" });
    expect(grid?.values).toEqual([
      [-50, -75],
      [0, null],
    ]);
    expect(grid && shareBelow(grid, 0)).toEqual({ below: 3, computed: 3, gaps: 1 });
    expect(grid && shareBelow(grid, -60)).toEqual({ below: 1, computed: 3, gaps: 1 });
  });

  it("shows where runs are still to come what the nearest ones have", () => {
    const at = [0, 1, 2, 3].flatMap((height) => [0, 1, 2, 3].map((speed) => ({ height, speed })));
    const peak = [1, null, null, null, null, null, null, 2, null, null, null, null, 3, null, null, null];
    const columns: Columns = {
      run: at.map((_, index) => index),
      strategy: at.map(() => "lv"),
      height: at.map(({ height }) => height),
      speed: at.map(({ speed }) => speed),
      peak,
      status: peak.map((value, index) => (index === 5 ? "failed" : value === null ? "waiting" : "ok")),
    };
    const grid = mapGrid(columns, { ...QUESTION, scale: 1 });
    expect(grid && coarse(grid, columns)).toEqual([
      [null, 1, 3, null],
      [1, null, 3, 3],
      [1, 2, 2, 3],
      [2, null, 2, 2],
    ]);
  });

  it("knows where a tyre was in the air, and where a change may be random", () => {
    const grid = mapGrid(
      { ...COLUMNS, "events.airborne_ms": [0, 0, 5, 0, 0.5, 0, 0, 9] },
      { ...QUESTION, against: "passive", oneRoadNoise: 60 },
    );
    if (!grid) throw new Error("no grid");
    const required = { ...COLUMNS, requirements: ["pass", null, "fail", null, "fail", null, "pass", null] };
    expect([failing(grid, required), firstFailure(grid, required), firstFailure(grid, COLUMNS)]).toEqual([
      [
        [false, true],
        [true, false],
      ],
      2,
      null,
    ]);
    expect(hatched(grid, { ...COLUMNS, "events.airborne_ms": [0, 0, 5, 0, 0.5, 0, 0, 9] })).toEqual([
      [false, false],
      [true, false],
    ]);
    expect(hatched(grid, { ...COLUMNS, "events.stop_contact_ms": [3, 0, 0, 0, 0, 0, 0.5, 0] })).toEqual([
      [true, false],
      [false, false],
    ]);
    expect(grid.unsettled).toEqual([
      [true, false],
      [true, false],
    ]);
  });

  it("over several roads has the change of the means, which is open where its interval holds zero", () => {
    // On three roads LV has half of what the passive car has; at the other speed sometimes less and sometimes more.
    const peaks = { lv: [1, 2, 3, 1, 5, 2], passive: [2, 4, 6, 2, 4, 3] };
    const rows = (["lv", "passive"] as const).flatMap((strategy) =>
      [20, 40].flatMap((speed, part) =>
        [1, 2, 3].flatMap((seed, road) =>
          [5, 10].map((height) => ({ strategy, speed, seed, height, peak: peaks[strategy][3 * part + road] ?? 0 })),
        ),
      ),
    );
    const columns: Columns = {
      run: rows.map((_, index) => index),
      "road.seed": rows.map(({ seed }) => seed),
      ...Object.fromEntries(
        (["strategy", "speed", "height", "peak"] as const).map((key) => [key, rows.map((row) => row[key])]),
      ),
    };
    const own = mapGrid(columns, QUESTION);
    expect(own?.values).toEqual([
      [20, 20],
      [expect.closeTo(80 / 3, 9), expect.closeTo(80 / 3, 9)],
    ]);
    expect(own?.rows[0]?.[0]).toEqual([0, 2, 4]);
    const change = mapGrid(columns, { ...QUESTION, against: "passive", oneRoadNoise: 60 });
    expect(change?.values).toEqual([
      [-50, -50],
      [expect.closeTo(-100 / 9, 9), expect.closeTo(-100 / 9, 9)],
    ]);
    expect(change?.halves[0]).toEqual([0, 0]);
    expect(change?.unsettled).toEqual([
      [false, false],
      [true, true],
    ]);
  });

  it("says of runs stored before bump stops were recorded that they were", () => {
    const done = { ...COLUMNS, status: COLUMNS.run?.map(() => "ok") ?? [] };
    const stops = { "events.stop_contact_ms": COLUMNS.run?.map(() => 0) ?? [] };
    expect([lacksStops(done), lacksStops({ ...done, ...stops })]).toEqual([true, false]);
  });

  it("needs a grid: scattered points have none", () => {
    const many = Array.from({ length: 50 }, (_, index) => index);
    expect(
      mapGrid({ run: many, strategy: many.map(() => "lv"), height: many, speed: many, peak: many }, QUESTION),
    ).toBeNull();
    expect(mapGrid({ ...COLUMNS, height: COLUMNS.run?.map(() => 5) ?? [] }, QUESTION)).toBeNull();
  });

  it("is drawn with a line at the threshold, seen on every colour", () => {
    const grid = mapGrid(COLUMNS, QUESTION);
    if (!grid) throw new Error("no grid");
    const axis = (name: string) => ({ name, title: name, unit: "m" });
    const rest = {
      grid,
      x: axis("height"),
      y: axis("speed"),
      title: "Peak",
      unit: "m/s^2",
      coarse: [],
      hatched: [],
      failing: [],
      textOf: (row: number, value: number) => [`run ${row}`, String(value)],
      palette: { text: "#000", grid: "#ccc", zero: "#999" },
      scheme: "light",
    } as const;
    const drawn = mapFigure({ ...rest, difference: false, threshold: 20 }).data as readonly GridTrace[];
    expect(drawn.map(({ type }) => type)).toEqual(["heatmap", "contour", "contour"]);
    expect([drawn[0]?.customdata, drawn[0]?.text?.[1], drawn[1]?.contours]).toEqual([
      [
        [0, 4],
        [2, 6],
      ],
      ["run 2<br>30", ""],
      { start: 20, end: 20, size: 1, coloring: "none" },
    ]);
    const [change] = mapFigure({ ...rest, difference: true, threshold: null }).data as readonly GridTrace[];
    expect([change?.zmin, change?.zmax]).toEqual([-30, 30]);
    const marked = { hatched: [[false], [true, false]], grid: { ...grid, unsettled: [[true, false], [false]] } };
    const coming = { coarse: [[null], [null, 30]] };
    const { data, layout } = mapFigure({ ...rest, ...marked, ...coming, difference: true, threshold: null });
    expect(data.slice(1)).toEqual([
      expect.objectContaining({ type: "heatmap", z: [[null], [null, 30]], zmin: -30, zmax: 30 }),
      expect.objectContaining({ type: "heatmap", z: [[1, null], [null]] }),
    ]);
    // The cell of 5 and 40 reaches from 2.5 to 7.5 and from 30 to 50.
    const path = "M 2.5,40 L 5,50 M 2.5,30 L 7.5,50 M 5,30 L 7.5,40";
    expect(layout.shapes).toEqual([expect.objectContaining({ type: "path", path })]);
  });
});

it("a front has the runs that none betters in both", () => {
  const points = [
    { strategy: "lv", rows: [0, 1, 2], x: [1, 2, 3], y: [9, 4, 4] },
    { strategy: "lqr", rows: [3, 4], x: [2, 5], y: [5, 1] },
  ];
  expect(frontOf(points).map(({ row }) => row)).toEqual([0, 1, 4]);
});
