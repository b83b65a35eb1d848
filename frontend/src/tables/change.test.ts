import { describe, expect, it } from "vitest";
import { changeAgainst, formatPercent } from "./change";

describe("change against the baseline", () => {
  it("is in percent, lower is better", () => {
    expect(changeAgainst(0.63, 1.12)).toEqual({ percent: expect.closeTo(-43.75) as number, verdict: "better" });
    expect(changeAgainst(0.46, 0.44).verdict).toBe("worse");
    expect(changeAgainst(1, 1)).toEqual({ percent: 0, verdict: "same" });
  });

  it("does not exist against nothing or zero", () => {
    expect(changeAgainst(5, 0)).toEqual({ percent: null, verdict: "none" });
    expect(changeAgainst(null, 5).percent).toBeNull();
    expect(changeAgainst(5, undefined).percent).toBeNull();
  });

  it("always shows its sign", () => {
    expect([-43.75, 4.55, 0, 160.2].map(formatPercent)).toEqual(["−43.8\u2009%", "+4.5\u2009%", "±0.0\u2009%", "+160\u2009%"]);
  });
});
