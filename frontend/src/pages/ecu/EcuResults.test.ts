import { describe, expect, it } from "vitest";
import type { Summary } from "../../api/types";
import { conclusionOf, rowsOf } from "./EcuResults";

/** Only what the rule reads. */
const summary = (rms: number, peak: number) =>
  ({ metrics: { rough_road: { a: { rms, peak: 0 } }, bump: { a: { rms: 0, peak } } } }) as unknown as Summary;

describe("the ±8 % rule", () => {
  it("reads RMS on the rough road and peaks on the bump", () => {
    const rows = rowsOf({ paper_signals: ["a"] }, { lv: summary(2, 4), lv_hil: summary(2.1, 3), lqr: summary(5, 6) });
    expect(rows.map(({ key, values: { lv, lv_hil, lqr } }) => [key, lv, lv_hil, lqr])).toEqual([
      ["rough_road.a.rms", 2, 2.1, 5],
      ["bump.a.peak", 4, 3, 6],
    ]);
    expect(rows.map(({ change }) => change?.toFixed(6))).toEqual(["5.000000", "-25.000000"]);
  });

  it.each([
    [1.08, true],
    [0.92, true],
    [1.0801, false],
    [0.9199, false],
  ])("a ratio of %d is within: %s", (ratio, within) => {
    expect(
      rowsOf({ paper_signals: ["a"] }, { lv: summary(100, 100), lv_hil: summary(100 * ratio, 100) })[0]?.within,
    ).toBe(within);
  });

  it("says nothing where there is nothing to compare", () => {
    const rows = rowsOf({ paper_signals: ["a"] }, { lv: summary(0, 1) });
    expect(rows.map(({ within }) => within)).toEqual([null, null]);
  });
});

it("The conclusion says what got worse and what got better, by how much at most, and what is left of the lead", () => {
  const rows = rowsOf({ paper_signals: ["a"] }, { lv: summary(2, 4), lv_hil: summary(2.1, 3), lqr: summary(5, 2) });
  expect(conclusionOf(rows, ({ key }) => key)).toBe(
    "Of 2 metrics the ECU’s code makes LV worse in 1 (+5.0\u2009% at most: rough_road.a.rms) " +
      "and better in 1 (−25.0\u2009% at most: bump.a.peak); it is better than LQR in 1.",
  );
  expect(conclusionOf([], String)).toBe("");
});
