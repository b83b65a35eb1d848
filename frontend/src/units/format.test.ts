import { describe, expect, it } from "vitest";
import {
  count,
  formatExact,
  formatHalf,
  formatFixed,
  formatInput,
  formatNumber,
  formatResult,
  parseInput,
  prettyUnit,
} from "./format";

describe("numbers", () => {
  it("are shown with significant digits", () => {
    expect([0.14873, 6.19, 8582.5, 22245, -0.0012, 0, 6.4e-7, 999.96].map((value) => formatNumber(value))).toEqual([
      "0.149",
      "6.19",
      "8583",
      "22\u202f245",
      "−0.00120",
      "0",
      "6.4×10⁻⁷",
      "1000",
    ]);
  });

  it("of a result are zero where they are rounding errors", () => {
    expect([1e-14, -3e-12, 6.4e-7, 0].map((value) => formatResult(value))).toEqual(["0", "0", "6.4×10⁻⁷", "0"]);
  });

  it("count things", () => {
    expect([count(1, "run"), count(1200, "run"), count(12345, "strategy", "strategies")]).toEqual([
      "1 run",
      "1200 runs",
      "12\u202f345 strategies",
    ]);
  });

  it("keep their decimals where they stand in a row", () => {
    expect([-0.004, 1.005, -12.34].map((value) => formatFixed(value, 2))).toEqual(["0.00", "1.00", "−12.34"]);
  });

  it("are typed with all their digits", () => {
    expect([0.1, 1536.7, 6.4e-5, 1e-9, 100000000].map(formatInput)).toEqual([
      "0.1",
      "1536.7",
      "6.4e-5",
      "1e-9",
      "100000000",
    ]);
  });

  it("are read as people type them, and never guessed", () => {
    expect(["0.12", " -3 ", "−3", "1e-9", "0,125", "2,5", ".5"].map(parseInput)).toEqual([
      0.12, -3, -3, 1e-9, 0.125, 2.5, 0.5,
    ]);
    expect(["", "5,000", "1.2.3", "0x10", "Infinity", "NaN", "12m"].map(parseInput)).toEqual(Array(7).fill(null));
  });
});

describe("defaults and limits", () => {
  it("are exact", () => {
    expect([4, -1, 1536.7, 268000, 64e-6].map((value) => formatExact(value, "m^3"))).toEqual([
      "4\u00a0m³",
      "−1\u00a0m³",
      "1536.7\u00a0m³",
      "268\u202f000\u00a0m³",
      "6.4e-5\u00a0m³",
    ]);
  });
});

describe("units", () => {
  it("are set with real exponents", () => {
    expect(["m^3", "kg·m^2", "1/N^2", "m/s^1.75", "1"].map(prettyUnit)).toEqual(["m³", "kg·m²", "1/N²", "m/s¹·⁷⁵", ""]);
  });
});

it("half an interval's width has the decimals of what it stands behind", () => {
  expect(formatHalf(0.0066, "0.163")).toBe("0.007");
  expect(formatHalf(0.29, "10.0")).toBe("0.3");
  expect(formatHalf(75.2, "816")).toBe("75");
  expect(formatHalf(0.004, "10.0")).toBe("0.004");
});
