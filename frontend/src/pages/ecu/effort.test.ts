import { describe, expect, it } from "vitest";
import { formatEnds, formatTime, kilobytes, largestLoss } from "./BuildReport";

describe("memory and times", () => {
  it.each([
    [1.4e-4, "140\u00a0µs"],
    [0.00824, "8.24\u00a0ms"],
    [1.25, "1.25\u00a0s"],
    [0.01, "10\u00a0ms"],
  ])("%d is %s", (seconds, text) => expect(formatTime(seconds)).toBe(text));

  it("has one value where both ends read the same", () => {
    expect(formatEnds({ least: 0.002, most: 0.003 }, formatTime)).toBe("2\u00a0ms – 3\u00a0ms");
    expect(formatEnds({ least: 0.002, most: 0.0020001 }, formatTime)).toBe("2\u00a0ms");
  });

  it("counts in units of 1024", () => expect(kilobytes(524288)).toBe("512\u00a0KB"));
});

it("the largest loss is the largest rise, over both windows", () => {
  expect(largestLoss({ rough_road: { a: -20, b: 3 }, bump: { a: null, b: 7 } })).toBe(7);
});
