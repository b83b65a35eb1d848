import { expect, test } from "vitest";
import { readRun } from "./client";
import type { RoadsAnswer, RunAnswer } from "./types";

const interval = (mean: number) => ({ mean, low: mean - 1, high: mean + 1 });
const drive = {
  core_version: null,
  compute_ms: 1,
  events: {},
  reference: {},
  source: null,
  stages: [],
  travel_time: 9,
  arrival_speed_kmh: 30,
};

test("a run over several roads reads as its means, with the intervals beside", () => {
  const answer: RoadsAnswer = {
    id: "x",
    core_version: "1",
    cautions: [],
    comparison: {
      baseline: "passive",
      changes: {},
      changes_against: {},
      verdict: { text: "", best: {}, mixed: false },
      cautions: [],
      requirements: [],
    },
    characteristics: {
      static_sag: { front: 0, rear: 0 },
      natural_frequencies: { front_body: 1, rear_body: 1, front_wheel: 10, rear_wheel: 10 },
      damping_ratios: { front_body: 1, rear_body: 1, front_wheel: 1, rear_wheel: 1 },
    },
    scenario: {},
    roads: 3,
    baseline: "passive",
    changes: {},
    strategies: {
      lv: {
        ...drive,
        status: "ok",
        metrics: { bump: { body_acceleration: { rms: interval(2), peak: interval(5) } } },
        comfort: { weighted_rms: interval(0.5) },
      },
      lqr: { status: "failed", compute_ms: 1, reason: "Road seed 2: no", kind: "refused", fields: [] },
    },
  };
  const run = readRun(answer);
  const lv = run.strategies.lv;
  expect(lv).toMatchObject({
    metrics: { bump: { body_acceleration: { rms: 2, peak: 5 } } },
    comfort: { weighted_rms: 0.5 },
    travel_time: 9,
  });
  expect(run.strategies.lqr).toEqual(answer.strategies.lqr);
  expect(run.over).toMatchObject({ roads: 3, baseline: "passive" });
  expect(run.over?.estimates.lv?.metrics.bump?.body_acceleration?.peak).toEqual(interval(5));
  expect(run).not.toHaveProperty("changes");
});

test("a run of one road stays what it is", () => {
  const answer: RunAnswer = { id: "x", core_version: "1", scenario: {}, strategies: {} };
  expect(readRun(answer)).toEqual({ ...answer, over: null });
});
