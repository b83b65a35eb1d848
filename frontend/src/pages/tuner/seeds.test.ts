import { describe, expect, it } from "vitest";
import { formatSeeds, readSeeds } from "./draft";

describe("seeds as typed", () => {
  it.each([
    ["1-4", [1, 2, 3, 4]],
    ["7", [7]],
    ["1–3, 9; 2 0", [1, 2, 3, 9, 0]],
  ])("%s", (text, seeds) => expect(readSeeds(text, 10)).toEqual({ ok: true, seeds }));

  it.each(["", " , ", "4-1", "1-", "-3", "1.5", "x", "99999999999", "1-11", "1-6 21-26"])("%s is refused", (text) => {
    expect(readSeeds(text, 10).ok).toBe(false);
  });

  it.each([
    [[1, 2, 3, 4], "1-4"],
    [[101, 102, 7, 9, 10, 11], "101, 102, 7, 9-11"],
    [[5], "5"],
  ])("%j is written short", (seeds, text) => expect(formatSeeds(seeds)).toBe(text));
});
