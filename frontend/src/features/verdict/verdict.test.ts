import { expect, it, describe } from "vitest";
import type { Catalogue, Interval, OverRoads, Scenario, Strategy, Summary } from "../../api/types";
import type { Result } from "../../lab/result";
import type { Labels } from "../../server/useCatalogues";
import { withFields } from "../../scenario/fields";
import { isRandom } from "../tables/entries";
import { changedMost, editChanges } from "./ChangeChips";
import { leaderOf, rivalOf, scoreOf, sentenceOf, speedsOf, type PairedAgainst } from "./VerdictLine";

const SIGNALS = ["body_acceleration", "pitch_acceleration"];
const CATALOGUE = {
  paper_signals: SIGNALS,
  signals: SIGNALS.map((key) => ({ key, label: key === "body_acceleration" ? "Body acceleration" : "Pitch" })),
  unit: () => ({ unit: "", scale: 1 }),
} as unknown as Catalogue & Pick<Labels, "unit">;
const [LV, LQR, PASSIVE] = (["LV", "LQR", "Passive"] as const).map(
  (label) => ({ id: label.toLowerCase(), label, one_road_resolution: { rms: 7, peak: 15 } }) as unknown as Strategy,
) as [Strategy, Strategy, Strategy];

/** Of both signals: RMS on the rough road, peak on the bump. */
const summary = ([bodyRms, pitchRms, bodyPeak, pitchPeak]: readonly number[], arrival_speed_kmh: number) =>
  ({
    arrival_speed_kmh,
    metrics: {
      rough_road: { body_acceleration: { rms: bodyRms }, pitch_acceleration: { rms: pitchRms } },
      bump: { body_acceleration: { peak: bodyPeak }, pitch_acceleration: { peak: pitchPeak } },
    },
  }) as unknown as Summary;

function compared(summaries: Readonly<Record<string, Summary>>, over: OverRoads | null = null) {
  const shown = { runId: "now", source: "exact", over, summaries } as unknown as Result;
  return { shown, summaries, strategies: [LV, LQR, PASSIVE].filter(({ id }) => id in summaries) };
}

const ONE_ROAD = compared({
  lv: summary([1, 1, 1, 1.05], 22.5),
  lqr: summary([2, 1.02, 2, 1], 22.5),
  passive: summary([3, 3, 6, 8], 50),
});

/** Nothing is random. */
const SMOOTH: Scenario = {
  road: { roughness: 0, profile: null },
  mismatch: { preview_noise: 0 },
  estimation: { kind: "exact" },
  hil: { noise: 0, jitter: 0, packet_loss: 0 },
};

const sentence = (of: typeof ONE_ROAD, paired: PairedAgainst = {}) => {
  const leader = leaderOf(of, CATALOGUE);
  const said = leader && sentenceOf(of, CATALOGUE, { leader, rival: rivalOf(of, leader, "passive") }, paired);
  return said && said.lead + said.rest;
};

describe("the verdict on one road", () => {
  it("counts a metric as won only where the difference to every other is more than luck", () => {
    expect(scoreOf(ONE_ROAD, CATALOGUE, LV, {})).toEqual({ best: 2, behind: 0, equal: 0, of: 4 });
    expect(sentence(ONE_ROAD)).toBe(
      "LV is best in 2 of 4 metrics, within luck in 2. Peak body acceleration on the bump −83.3\u2009% " +
        "(luck ±\u200915\u2009%) against Passive, at 22.5 instead of 50.0 km/h.",
    );
  });

  it("says where another is better for sure", () => {
    const behind = compared({ lv: summary([1, 1, 1, 2], 20), lqr: summary([2, 2, 2, 1], 20) });
    expect(scoreOf(behind, CATALOGUE, LV, {})).toEqual({ best: 3, behind: 1, equal: 0, of: 4 });
    expect(sentence(behind)).toContain("LV is best in 3 of 4 metrics, behind in 1.");
    expect(sentence(behind)).toContain("all at 20.0 km/h");
  });

  it("names no winner where nothing is beyond luck", () => {
    const alike = compared({ lv: summary([1, 1, 1, 1], 20), lqr: summary([1.05, 1.05, 1.1, 1.1], 20) });
    expect(sentence(alike)).toBe(
      "No clear winner in 4 metrics, within luck in 4. Peak body acceleration on the bump LV no different beyond luck " +
        "against LQR, all at 20.0 km/h.",
    );
  });

  it("says where strategies are equal", () => {
    const same = compared({ lv: summary([1, 1, 1, 1], 20), lqr: summary([1, 1, 1, 1.05], 20) });
    expect(sentence(same)).toBe(
      "No clear winner in 4 metrics, equal in 3, within luck in 1. Peak body acceleration on the bump LV no different " +
        "against LQR, all at 20.0 km/h.",
    );
  });

  it("is equal where the leader equals one and betters another", () => {
    const level = {
      lv: summary([0, 0, 2, 1], 20),
      lqr: summary([0, 0.5, 2, 2], 20),
      passive: summary([0, 0, 3, 2], 20),
    };
    const of = compared(level);
    const smooth = { ...of, shown: { ...of.shown, scenario: SMOOTH } };
    expect(scoreOf(smooth, CATALOGUE, LV, {})).toEqual({ best: 1, behind: 0, equal: 3, of: 4 });
    expect(sentence(smooth)).toBe(
      "LV is best in 1 of 4 metrics, equal in 3. Peak body acceleration on the bump −33.3 % against Passive, " +
        "all at 20.0 km/h.",
    );
  });

  it("says neither luck nor percent of what is not to be compared", () => {
    const of = compared({ lv: summary([1, 1, 1, 1], 20), lqr: summary([0, 2, 0, 2], 20) });
    const smooth = { ...of, shown: { ...of.shown, scenario: SMOOTH } };
    expect(sentence(smooth)).toContain("Peak body acceleration on the bump not to be compared in percent against LQR");
    expect(sentence(smooth)).not.toContain("luck");
  });

  it("knows no luck on a smooth road", () => {
    const { shown, ...rest } = ONE_ROAD;
    const smooth = { ...rest, shown: { ...shown, scenario: SMOOTH } };
    expect(sentence(smooth)).toBe(
      "LV is best in 3 of 4 metrics, behind in 1. Peak body acceleration on the bump −83.3\u2009% against Passive, " +
        "at 22.5 instead of 50.0 km/h.",
    );
  });

  it.each([
    ["road.roughness", 1e-6],
    ["road.profile", "a road"],
    ["mismatch.preview_noise", 1e-4],
    ["estimation.kind", "kalman"],
    ["hil.noise", 0.001],
    ["hil.jitter", 0.001],
    ["hil.packet_loss", 0.01],
  ])("knows luck on a road with %s", (name, value) => {
    const { shown, ...rest } = ONE_ROAD;
    expect(sentence({ ...rest, shown: { ...shown, scenario: withFields(SMOOTH, { [name]: value }) } })).toBe(
      sentence(ONE_ROAD),
    );
    expect(isRandom(SMOOTH)).toBe(false);
    expect(isRandom(SMOOTH, ["road.bump.height", name])).toBe(true);
  });

  it("is of what this road has, and says nothing of a single strategy", () => {
    const flat = compared({ lv: summary([1, 1], 20), passive: summary([2, 2], 20) });
    expect(sentence(flat)).toContain("best in 2 of 2 metrics. RMS body acceleration on the rough road −50.0\u2009%");
    expect(leaderOf(compared({ lv: summary([1, 1, 1, 1], 20) }), CATALOGUE)).toBeNull();
  });
});

describe("the verdict over several roads", () => {
  const interval = (mean: number, half: number): Interval => ({ mean, low: mean - half, high: mean + half });
  const against = (id: string, rms: Interval, peak: Interval) =>
    ({
      [id]: {
        rough_road: { body_acceleration: { rms }, pitch_acceleration: { rms } },
        bump: { body_acceleration: { peak }, pitch_acceleration: { peak } },
      },
    }) as unknown as OverRoads["changes"];
  const over = { roads: 5, baseline: "passive", estimates: {} } as unknown as OverRoads;
  const two = compared({ lv: summary([1, 1, 1, 1], 22.5), passive: summary([2, 2, 2, 2], 50) }, over);

  it("counts what the paired intervals settle, and prints the headline's", () => {
    const paired = {
      lv: against("passive", interval(3, 4), interval(100, 9)),
      passive: against("lv", interval(-3, 4), interval(-50, 4)),
    };
    expect(sentence(two, paired)).toBe(
      "LV is best in 2 of 4 metrics, within luck in 2. Peak body acceleration on the bump " +
        "−50\u2009±\u20094\u2009% against Passive, at 22.5 instead of 50.0 km/h.",
    );
  });

  it("waits for the intervals", () => {
    expect(sentence(two)).toBeNull();
  });
});

it("Speeds are one where all meet the bump alike", () => {
  expect(speedsOf(ONE_ROAD)).toEqual([22.5, 22.5, 50]);
  expect(speedsOf(compared({ lv: summary([1, 1, 1, 1], 22.4), lqr: summary([1, 1, 1, 1], 22.5) }))).toEqual([22.4]);
});

it("An edit's changes are each strategy's own, first those of the one that it moved", () => {
  const now = compared({ lv: summary([1, 1, 1, 1], 20), passive: summary([2, 2, 2, 2], 20) });
  const old = compared({ lv: summary([1, 1, 1, 1], 20), passive: summary([4, 2.1, 2, 1], 20) });
  const changes = editChanges(now, { name: "before the last edit", shown: old.shown }, CATALOGUE, undefined);
  expect(changes.map(({ change }) => change?.verdict)).toEqual([
    ...Array<string>(4).fill("same"),
    "better",
    "luck",
    "same",
    "worse",
  ]);
  expect(changedMost(changes, now.strategies)).toBe(PASSIVE);
});
