import { describe, expect, it } from "vitest";
import type { Strategy } from "../../api/types";
import { markersOf } from "../../plots/markers";
import { drawnAxes, nearest, locate } from "./PointsPlot";
import { linesOf, MANY, scatterFigure } from "./scatter";
import { secondsLeft, withMark, type Mark } from "../../jobs/useJob";
import { stringifySearch } from "../../lab/address";
import { searchOf, viewOf } from "./view";
import { inOrder } from "../../lib/order";
import { lowest, pointsOf, rowsOf, type Columns } from "../../features/sweep/table";

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
    expect(inOrder([0, 1, 2, 3], (row) => COLUMNS.peak?.[row])).toEqual([0, 3, 1, 2]);
    expect(inOrder([0, 1, 2, 3], (row) => COLUMNS.peak?.[row], true)).toEqual([1, 3, 0, 2]);
    expect(inOrder([0, 1, 2, 3], (row) => COLUMNS.strategy?.[row])).toEqual([0, 2, 1, 3]);
  });

  it("can be kept by what they are", () => {
    expect(rowsOf(COLUMNS, (row) => COLUMNS.status?.[row] === "failed")).toEqual([2]);
    expect(rowsOf({}, () => true)).toEqual([]);
  });

  it("have a best one, unless none has a value", () => {
    expect(lowest(COLUMNS, [1, 2, 3], "peak")).toBe(3);
    expect(lowest(COLUMNS, [2], "peak")).toBeNull();
  });

  it("are points in the order of x, without those that failed", () => {
    expect(pointsOf(COLUMNS, ["passive", "lv"], "road.bump.height", "peak", 10)).toEqual([
      { strategy: "passive", rows: [3, 1], x: [0.05, 0.1], y: [31, 62] },
      { strategy: "lv", rows: [0], x: [0.1], y: [9] },
    ]);
  });
});

describe("points that differ in x only", () => {
  const columns: Columns = {
    run: [0, 1, 2, 3, 4],
    strategy: Array<string>(5).fill("lv"),
    height: [1, 1, 2, 2, 3],
    speed: [15, 25, 15, 25, 35],
    peak: [5, 6, 7, 8, 9],
  };

  it("are a line for each combination of the others, a point alone is none", () => {
    const points = pointsOf(columns, ["lv"], "height", "peak", 1);
    expect(linesOf(columns, points, ["speed"])).toEqual([
      {
        strategy: "lv",
        x: [1, 2, null, 1, 2, null],
        y: [5, 7, null, 6, 8, null],
      },
    ]);
    expect(linesOf(columns, points, [])[0]?.x).toEqual([1, 1, 2, 2, 3, null]);
  });

  it("are no lines where there would be a tangle", () => {
    const many = Array.from({ length: 100 }, (_, index) => index);
    const tangle: Columns = {
      run: many,
      strategy: many.map(() => "lv"),
      height: many.map((row) => row % 2),
      speed: many.map((row) => row - (row % 2)),
      peak: many,
    };
    expect(linesOf(tangle, pointsOf(tangle, ["lv"], "height", "peak", 1), ["speed"])).toEqual([]);
  });
});

describe("a strategy's marker", () => {
  it("is its own, whatever is swept", () => {
    expect(markersOf([{ id: "lv" }, { id: "lqr" }, { id: "passive" }])).toEqual({
      lv: "circle",
      lqr: "diamond",
      passive: "square",
    });
  });
});

describe("how a sweep is looked at", () => {
  it("is in the address, and short for the usual view", () => {
    const usual = viewOf({});
    expect(
      stringifySearch(searchOf({ ...usual, x: "road.bump.width", y: "travel_time", hidden: ["lqr", "passive"] })),
    ).toBe("?x=road.bump.width&y=travel_time&hide=lqr,passive");
    const view = {
      ...usual,
      plot: "trade_off",
      strategy: "lv",
      against: "none",
      threshold: -10,
      versus: "travel_time",
    } as const;
    expect(stringifySearch(searchOf(view))).toBe("?plot=trade_off&strategy=lv&against=none&at=-10&versus=travel_time");
    expect(viewOf(searchOf(view))).toEqual(view);
    expect(searchOf(usual)).toEqual({});
  });

  it("may be without a line, where a map usually has one", () => {
    const view = viewOf({ at: "none" });
    expect([view.threshold, searchOf(view).at]).toEqual(["none", "none"]);
    expect(["", "high"].map((at) => viewOf({ at }).threshold)).toEqual([null, null]);
  });
});

describe("a plot of many points", () => {
  const strategies = [
    { id: "lv", label: "LV control", colour: "#00f" },
    { id: "passive", label: "Passive", colour: "#555" },
  ] as unknown as Strategy[];
  const x = { name: "road.bump.height", title: "Height", unit: "m", linked_to: null };
  const y = { key: "peak", label: "Body acceleration", group: "Peak, bump", unit: "m/s^2", scale: 1 };
  const palette = { text: "#000", grid: "#ccc", zero: "#999" };
  const points = (count: number) => {
    const list = Array.from({ length: count }, (_, index) => index + 1);
    return [
      { strategy: "lv", rows: list, x: list.map((value) => value / count), y: list.map((value) => (value * 7) % 11) },
    ];
  };
  const rest = {
    strategies,
    markers: markersOf(strategies),
    x,
    y,
    lines: [],
    curves: false,
    isHollow: (row: number) => row === 2,
    textOf: (row: number) => [`run ${row}`, "Height"],
    palette,
  };
  const figure = (count: number) => scatterFigure({ ...rest, points: points(count), ringed: [11] });

  it("is plotly's own while there are few", () => {
    const { data, dots, count } = figure(100);
    expect([count, dots.length, data.map(({ x: xs }) => xs.length)]).toEqual([100, 0, [100, 1]]);
  });

  it("draws airborne runs hollow, and says where a point is", () => {
    const [trace] = figure(3).data;
    expect(trace).toMatchObject({
      marker: { symbol: ["circle", "circle-open", "circle"] },
      text: expect.arrayContaining(["run 1<br>Height"]) as unknown,
    });
    expect(figure(MANY + 1).dots[0]?.hollow.slice(0, 3)).toEqual([false, true, false]);
  });

  it("leaves plotly the axes alone, which span every point", () => {
    const { data, dots, count } = figure(MANY + 1);
    expect([count, dots.map(({ rows }) => rows.length)]).toEqual([MANY + 1, [MANY + 1]]);
    const [frame] = data;
    expect([Math.min(...(frame?.x ?? []).map(Number)), Math.max(...(frame?.x ?? []).map(Number))]).toEqual([
      1 / (MANY + 1),
      1,
    ]);
    expect([Math.min(...(frame?.y ?? []).map(Number)), Math.max(...(frame?.y ?? []).map(Number))]).toEqual([0, 10]);
  });

  it("has decades for a field that spans them, and names for choices", () => {
    const decades = [{ strategy: "lv", rows: [0, 1], x: [1e-6, 1e-3], y: [1, 2] }];
    const names = [{ strategy: "lv", rows: [0, 1], x: ["cosine", "flat_top"], y: [1, 2] }];
    const figureOf = (list: typeof decades | typeof names) => scatterFigure({ ...rest, points: list, ringed: [] });
    expect(figureOf(decades).layout.xaxis).toMatchObject({ type: "log" });
    expect(figureOf(names).data[0]?.x).toEqual(["Cosine", "Flat top"]);
  });

  it("knows plotly's axes where they are as they have been, else none", () => {
    const axis = { _offset: 0, _length: 100, d2p: Number };
    const host = (layout: object) => ({ _fullLayout: layout }) as unknown as HTMLElement;
    expect(drawnAxes(host({ xaxis: axis, yaxis: axis }))).toEqual({ xaxis: axis, yaxis: axis });
    for (const other of [
      {},
      { xaxis: axis },
      { xaxis: axis, yaxis: { ...axis, d2p: undefined } },
      { xaxis: { ...axis, _offset: undefined }, yaxis: axis },
    ])
      expect(drawnAxes(host(other))).toBeNull();
    expect(drawnAxes({} as HTMLElement)).toBeNull();
  });

  it("finds the point under the pointer, where it is in sight", () => {
    const axis = (_offset: number) => ({ _offset, _length: 100, d2p: (value: number | string) => Number(value) * 10 });
    const axes = { xaxis: axis(50), yaxis: axis(0) };
    const { dots } = figure(MANY + 1);
    const located = locate(
      dots.map((each) => ({ ...each, rows: [7, 8, 9], x: [1, 2, 20], y: [1, 1, 1] })),
      axes,
    );
    expect([...(located[0]?.x ?? [])]).toEqual([60, 70, 250]);
    expect(nearest(located, axes, 68, 12, 12)?.index).toBe(1);
    expect(nearest(located, axes, 68, 40, 12)).toBeNull();
    expect(nearest(located, axes, 250, 10, 12)).toBeNull(); // zoomed out of sight
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
    const recent = marks([0, 0], [10_000, 1000], [60_000, 1100], [80_000, 1300]);
    expect(recent[0]).toEqual({ at: 60_000, finished: 1100 });
    expect(secondsLeft(recent, 1500)).toBe(20);
  });
});
