import { describe, expect, it } from "vitest";
import type { Strategy, Summary } from "../../api/types";
import { DEFAULT_VIEW } from "../../lab/address";
import {
  pinReference,
  NOTHING_COMPARED,
  type Reference,
  type Compared,
  type RoadPairedChanges,
} from "../../lab/compare";
import { makeResultView } from "../../lab/resultView";
import type { Result } from "../../lab/result";
import { withFields } from "../../scenario/fields";
import { changeOf, entryGroups, isRandom, lowestOf } from "./entries";

const PEAK = { window: "bump", signal: "body_acceleration", statistic: "peak" } as const;
const STRATEGIES = [
  ["lv", 15],
  ["passive", 7],
].map(([id, peak]) => ({ id, label: id, one_road_resolution: { rms: 7, peak } }) as unknown as Strategy);

const summary = (peak: number) =>
  ({ metrics: { bump: { body_acceleration: { rms: 1, peak } } }, stages: [] }) as unknown as Summary;
const shown = (runId: string, lv: number, passive: number, more: Partial<Result> = {}) =>
  ({
    runId,
    source: "exact",
    summaries: { lv: summary(lv), passive: summary(passive) },
    failed: [],
    series: {},
    over: null,
    ...more,
  }) as unknown as Result;

const NOW = shown("now", 1, 8);
const before = { name: "before the last edit", shown: shown("old", 2, 8) };
const compared: Compared = { ...NOTHING_COMPARED, before, pins: [{ name: "Soft", shown: shown("soft", 3, 6) }] };

function changes(reference: Reference, choice = compared) {
  const resultView = makeResultView(NOW, STRATEGIES, ["lv", "passive"], { ...DEFAULT_VIEW, reference }, choice);
  return entryGroups(resultView).map(({ name, entries }) => [
    name,
    ...entries.map((entry) => changeOf(resultView, entry, PEAK)?.percent ?? null),
  ]);
}

describe("the change of each strategy of each variant", () => {
  it("is reference the baseline of the same variant", () => {
    expect(changes("baseline")).toEqual([
      [null, -87.5, null],
      ["Soft", -50, null],
    ]);
  });

  it("is reference the same strategy before the last edit", () => {
    expect(changes("before")).toEqual([
      [null, -50, 0],
      ["Soft", 50, -25],
    ]);
  });

  it("is reference the same strategy of a pin, which itself has none", () => {
    expect(changes(pinReference("soft"))).toEqual([
      [null, expect.closeTo(-66.7, 1), expect.closeTo(33.3, 1)],
      ["Soft", null, null],
    ]);
  });

  it("does not exist between a mean over roads and one road", () => {
    const over = { roads: 5, baseline: "passive", changes: {}, estimates: {} };
    expect(changes("before", { ...compared, before: { ...before, shown: shown("old", 2, 8, { over }) } })[0]).toEqual([
      null,
      null,
      null,
    ]);
  });

  it("falls back to the baseline where what it was reference is gone", () => {
    expect(changes("before", NOTHING_COMPARED)).toEqual([[null, -87.5, null]]);
  });

  it("over several roads is paired with the variant's, once it is there", () => {
    const over = { roads: 5, baseline: "passive", changes: {}, estimates: {} };
    const roads = { scenario: { road: { seed: 1 } }, coreVersion: "1", over };
    const now = shown("now", 1, 8, roads);
    const soft = { name: "Soft", shown: shown("soft", 3, 6, roads) };
    const peak = { mean: 12, low: 8, high: 16 };
    const ofLv = (paired: object, pin = soft) => {
      const view = { ...DEFAULT_VIEW, reference: pinReference("soft") };
      const resultView = {
        ...makeResultView(now, STRATEGIES, ["lv", "passive"], view, { ...NOTHING_COMPARED, pins: [pin] }),
        roadPairedChanges: paired as RoadPairedChanges,
      };
      return entryGroups(resultView)[0]
        ?.entries.slice(0, 1)
        .map((entry) => changeOf(resultView, entry, PEAK))[0];
    };
    expect(ofLv({})).toBeNull();
    expect(ofLv({ now: { lv: { bump: { body_acceleration: { rms: null, peak } } } } })).toEqual({
      percent: 12,
      half: 4,
      verdict: "worse",
    });
    expect(ofLv({ now: {} })?.verdict).toBe("none");
    const otherSeed = { ...soft, shown: { ...soft.shown, scenario: { road: { seed: 2 } } } };
    expect(ofLv({}, otherSeed)?.verdict).toBe("none");
  });

  it("on one road may be random below what it resolves of the two strategies", () => {
    const close = shown("now", 1.1, 1.2);
    const resultView = makeResultView(close, STRATEGIES, ["lv", "passive"], DEFAULT_VIEW, {
      ...NOTHING_COMPARED,
      pins: [{ name: "Soft", shown: shown("soft", 1, 1) }],
    });
    const verdicts = (reference: Reference) => {
      const part = { ...resultView, reference: reference === "baseline" ? null : (resultView.pins[0] ?? null) };
      return entryGroups(part)[0]?.entries.map((entry) => changeOf(part, entry, PEAK)?.verdict);
    };
    expect(verdicts("baseline")).toEqual(["random", undefined]);
    expect(verdicts(pinReference("soft"))).toEqual(["random", "worse"]);
  });
});

it("One of all rows has the lowest value", () => {
  const variants = entryGroups(makeResultView(NOW, STRATEGIES, ["lv", "passive"], DEFAULT_VIEW, compared));
  expect(lowestOf(variants, PEAK)).toBe(1);
});

describe("what is random", () => {
  const smooth = {
    road: { roughness: 0, profile: null },
    mismatch: { preview_noise: 0 },
    estimation: { kind: "exact" },
    hil: { noise: 0, jitter: 0, packet_loss: 0 },
  };

  it.each([
    ["road.roughness", 1e-6],
    ["road.profile", "a road"],
    ["mismatch.preview_noise", 1e-4],
    ["estimation.kind", "kalman"],
    ["hil.noise", 0.001],
    ["hil.jitter", 0.001],
    ["hil.packet_loss", 0.01],
  ])("is a road with %s, set or varied", (name, value) => {
    expect(isRandom(smooth)).toBe(false);
    expect(isRandom(withFields(smooth, { [name]: value }))).toBe(true);
    expect(isRandom(smooth, ["road.bump.height", name])).toBe(true);
  });
});
