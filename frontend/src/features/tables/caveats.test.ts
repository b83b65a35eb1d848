import { describe, expect, it } from "vitest";
import { caveatsOf } from "./change";

const quantity = (key: string, unit: string, notable = 0) => ({
  key,
  label: key,
  symbol: "",
  unit,
  description: "what it means",
  notable,
});
const CATALOGUE = {
  events: [
    quantity("airborne_ms", "ms", 1),
    quantity("travel_exceeded_mm", "mm", 0.1),
    quantity("target_reached", "1"),
  ],
};
const texts = (events: Record<string, number | boolean | null>) => caveatsOf(events, CATALOGUE).map(({ text }) => text);

describe("the caveats of a result", () => {
  it("says why, in numbers", () => {
    expect(texts({ airborne_ms: 94, travel_exceeded_mm: 6.97, target_reached: false })).toEqual([
      "airborne 94\u00a0ms",
      "7\u00a0mm over the travel limit",
      "target speed not reached",
    ]);
    expect(texts({ airborne_ms: 142.4, travel_exceeded_mm: 0.34 })).toEqual([
      "airborne 142\u00a0ms",
      "0.34\u00a0mm over the travel limit",
    ]);
  });

  it("means what the catalogue says", () => {
    expect(caveatsOf({ airborne_ms: 1 }, CATALOGUE)[0]?.description).toBe("airborne_ms: what it means");
  });

  it("is none where nothing happened, no target was set, or less than the catalogue finds notable", () => {
    expect(texts({ airborne_ms: 0, travel_exceeded_mm: 0.007, target_reached: null })).toEqual([]);
    expect(texts({ target_reached: true })).toEqual([]);
    expect(caveatsOf(undefined, CATALOGUE)).toEqual([]);
  });
});
