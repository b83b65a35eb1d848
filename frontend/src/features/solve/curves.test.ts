import { describe, expect, it } from "vitest";
import { crossings, curveOf, rangesBelow, rangesText, type Point } from "./LimitChart";

const RISING: readonly Point[] = [
  [10, 1],
  [20, 2],
  [30, 4],
];
const HILL: readonly Point[] = [
  [0, 1],
  [1, 3],
  [2, 1],
];
const text = (value: number) => `${value} km/h`;

describe("where a curve keeps a limit", () => {
  it("is between crossings, by straight lines", () => {
    expect(rangesBelow(RISING, 3)).toEqual([[10, 25]]);
    expect(rangesBelow(HILL, 2)).toEqual([
      [0, 0.5],
      [1.5, 2],
    ]);
    expect(crossings(HILL, 2)).toEqual([0.5, 1.5]);
    expect(crossings(RISING, 9)).toEqual([]);
  });

  it("is said in words", () => {
    const said = (curve: readonly Point[], limit: number) => rangesText(curve, limit, text);
    expect(said(RISING, 3)).toBe("up to about 25 km/h");
    expect(said(RISING, 9)).toBe("keeps the limit over the whole range");
    expect(said(RISING, 0.5)).toBe("above the limit over the whole range");
    expect(said(HILL, 2)).toBe("up to about 0.5 km/h, and from about 1.5 km/h on");
    expect(said([], 2)).toBe("could not be driven");
  });
});

it("A curve is of the values that have the metric, in their order", () => {
  const tried = [
    { value: 2, metric_value: 5, run_id: "b", reason: null },
    { value: 3, metric_value: null, run_id: null, reason: "stuck" },
    { value: 1, metric_value: 4, run_id: "a", reason: null },
  ];
  expect(curveOf(tried)).toEqual([
    [1, 4],
    [2, 5],
  ]);
});
