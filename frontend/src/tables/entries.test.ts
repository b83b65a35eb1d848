import { describe, expect, it } from "vitest";
import type { Strategy, Summary } from "../api/types";
import { DEFAULT_VIEW } from "../state/address";
import { againstPin, type Against, type Compared } from "../state/compare";
import { makeScene } from "../state/scene";
import type { Shown } from "../state/shown";
import { changeOf, entryGroups } from "./entries";

const PEAK = { window: "bump", signal: "body_acceleration", statistic: "peak" } as const;
const STRATEGIES = ["lv", "passive"].map((id) => ({ id, label: id }) as Strategy);

const summary = (peak: number) => ({ metrics: { bump: { body_acceleration: { rms: 1, peak } } }, stages: [] }) as unknown as Summary;
const shown = (runId: string, lv: number, passive: number, more: Partial<Shown> = {}) =>
  ({ runId, source: "exact", summaries: { lv: summary(lv), passive: summary(passive) }, series: {}, over: null, ...more }) as unknown as Shown;

const NOW = shown("now", 1, 8);
const compared: Compared = { before: shown("old", 2, 8), pins: [{ name: "Soft", shown: shown("soft", 3, 6) }] };

function changes(against: Against, choice = compared) {
  const scene = makeScene(NOW, STRATEGIES, ["lv", "passive"], { ...DEFAULT_VIEW, against }, choice);
  return entryGroups(scene).map(({ name, entries }) => [name, ...entries.map((entry) => changeOf(scene, entry, PEAK)?.percent ?? null)]);
}

describe("the change of each strategy of each variant", () => {
  it("is against the baseline of the same variant", () => {
    expect(changes("baseline")).toEqual([[null, -87.5, null], ["Soft", -50, null]]);
  });

  it("is against the same strategy before the last edit", () => {
    expect(changes("before")).toEqual([[null, -50, 0], ["Soft", 50, -25]]);
  });

  it("is against the same strategy of a pin, which itself has none", () => {
    expect(changes(againstPin("soft"))).toEqual([[null, expect.closeTo(-66.7, 1), expect.closeTo(33.3, 1)], ["Soft", null, null]]);
  });

  it("does not exist between a mean over roads and one road", () => {
    const over = { roads: 5, baseline: "passive", changes: {}, estimates: {} };
    expect(changes("before", { ...compared, before: shown("old", 2, 8, { over }) })[0]).toEqual([null, null, null]);
  });

  it("falls back to the baseline where what it was against is gone", () => {
    expect(changes("before", { before: null, pins: [] })).toEqual([[null, -87.5, null]]);
  });
});
