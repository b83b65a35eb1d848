import { expect, it } from "vitest";
import { pairedChangeOf, studentQuantile } from "../pages/sweep/map";

it("Student's quantiles are those of the tables", () => {
  const tables = { 1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 9: 2.262, 19: 2.093, 49: 2.01, 1000: 1.962 };
  for (const [freedom, quantile] of Object.entries(tables))
    expect(Math.abs(studentQuantile(Number(freedom)) / quantile - 1)).toBeLessThan(0.0015);
});

it("a change of means has the interval of pairs", () => {
  // r = 0.8; residuals -0.2, 0.2, 0 over a mean of 2: their deviation is 0.1, of three roads.
  const change = pairedChangeOf([0.6, 1.8, 2.4], [1, 2, 3]);
  expect(change?.percent).toBeCloseTo(-20, 9);
  expect(change?.half).toBeCloseTo((100 * 4.3027 * 0.1) / Math.sqrt(3), 2);
  expect([pairedChangeOf([1], [2]), pairedChangeOf([1, 1], [0, 0])]).toEqual([null, null]);
  expect(pairedChangeOf([1, 1], [2, 2])).toEqual({ percent: -50, half: 0 });
});
