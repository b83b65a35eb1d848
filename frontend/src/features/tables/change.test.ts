import { describe, expect, it } from "vitest";
import { changeAgainst, formatPercent, pairedChange } from "./change";

describe("change against the baseline", () => {
  it("is in percent, lower is better", () => {
    expect(changeAgainst(0.63, 1.12)).toEqual({
      percent: expect.closeTo(-43.75) as number,
      half: 0,
      verdict: "better",
    });
    expect(changeAgainst(0.46, 0.44).verdict).toBe("worse");
    expect(changeAgainst(1, 1)).toEqual({ percent: 0, half: 0, verdict: "same" });
  });

  it("has no verdict between two equal shown numbers", () => {
    expect(changeAgainst(1.002, 1)).toEqual({ percent: expect.closeTo(0.2) as number, half: 0, verdict: "same" });
    expect(changeAgainst(0.0100449, 0.010049, { scale: 1000 }).verdict).toBe("same");
    expect(changeAgainst(1.006, 1).verdict).toBe("worse");
  });

  it("is random where one road resolves no less", () => {
    expect([1.1, 1.2, 0.9, 1].map((value) => changeAgainst(value, 1, { oneRoadNoise: 15 }).verdict)).toEqual([
      "random",
      "worse",
      "random",
      "same",
    ]);
  });

  it("does not exist against nothing or zero", () => {
    expect(changeAgainst(5, 0)).toEqual({ percent: null, half: 0, verdict: "none" });
    expect(changeAgainst(0, 0)).toEqual({ percent: null, half: 0, verdict: "same" });
    expect(changeAgainst(2e-4, 1e-8, { scale: 1e-3 }).verdict).toBe("same"); // on a flat road, in N
    expect(changeAgainst(null, 5).percent).toBeNull();
    expect(changeAgainst(5, undefined).percent).toBeNull();
  });

  it("shows its sign unless it is nothing", () => {
    expect([-43.75, 4.55, 0, 160.2].map((percent) => formatPercent(percent))).toEqual([
      "−43.8\u2009%",
      "+4.5\u2009%",
      "0.0\u2009%",
      "+160\u2009%",
    ]);
  });
});

describe("a change over several roads", () => {
  it("has a verdict only where its interval leaves out zero", () => {
    expect(pairedChange({ mean: -40, low: -43, high: -37 })).toEqual({ percent: -40, half: 3, verdict: "better" });
    expect(pairedChange({ mean: 4, low: 1, high: 7 }).verdict).toBe("worse");
    expect(pairedChange({ mean: -4, low: -9, high: 1 }).verdict).toBe("same");
    expect(pairedChange({ mean: 4, low: 1, high: 7 }, true).verdict).toBe("same"); // both means show the same digits
    expect(formatPercent(-40, 3)).toBe("−40\u2009±\u20093\u2009%");
    expect([-12e3, 9999, 12e3].map((percent) => formatPercent(percent))).toEqual([
      "< −9999\u2009%",
      "+9999\u2009%",
      "> +9999\u2009%",
    ]);
    expect([-12e3, 12e3].map((percent) => formatPercent(percent, 50))).toEqual([
      "< −9999\u2009±\u200950\u2009%",
      "> +9999\u2009±\u200950\u2009%",
    ]);
    expect(formatPercent(0.1, 0.04)).toBe("+0.1\u2009%");
    expect(formatPercent(0, 3)).toBe("0\u2009±\u20093\u2009%");
    expect(formatPercent(-93.11, 0.42)).toBe("−93.1\u2009±\u20090.4\u2009%");
  });
});
