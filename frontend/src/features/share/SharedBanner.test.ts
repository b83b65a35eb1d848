import { describe, expect, it } from "vitest";
import type { Catalogue, Run, Summary } from "../../api/types";
import { metricsOf } from "../../server/metrics";
import { compareRuns } from "./SharedBanner";

const quantity = (key: string, label: string, unit = "1") => ({
  key,
  label,
  unit,
  symbol: "",
  description: "",
  notable: 0,
});
const CATALOGUE: Catalogue = {
  signals: [quantity("body_acceleration", "Body acceleration", "m/s^2")],
  metric_signals: ["body_acceleration"],
  paper_signals: ["body_acceleration"],
  windows: [quantity("bump", "Bump")],
  statistics: [quantity("rms", "RMS"), quantity("peak", "Peak")],
  stages: [],
  comfort: [quantity("weighted_rms", "Weighted RMS", "m/s^2")],
  events: [quantity("target_reached", "Target speed reached")],
  run_figures: [quantity("travel_time", "Travel time", "s")],
  references: [],
};

const METRICS = metricsOf(CATALOGUE, {});

const summary = (peak: number, reached: boolean, weighted = 1): Summary => ({
  status: "ok",
  compute_ms: 1,
  travel_time: 12,
  arrival_speed_kmh: 22,
  reference: {},
  source: null,
  stages: [],
  metrics: { bump: { body_acceleration: { rms: 1, peak } } },
  comfort: { weighted_rms: weighted },
  events: { target_reached: reached },
});
const run = (strategies: Run["strategies"]): Run => ({
  id: "x",
  core_version: "1",
  scenario: {},
  strategies,
  over: null,
});

describe("the same scenario computed twice", () => {
  it("has no differences where all is equal", () => {
    const once = run({ lv: summary(2, true) });
    expect(compareRuns(once, once, METRICS)).toEqual({ differences: [], compared: 5, failed: [] });
  });

  it("lists what changed, the largest first, and what is no number before all", () => {
    const { differences } = compareRuns(run({ lv: summary(2, true, 1) }), run({ lv: summary(1, false, 1.1) }), METRICS);
    expect(differences.map(({ metric, then, now }) => [metric, then, now])).toEqual([
      ["Target speed reached", true, false],
      ["Body acceleration, peak, bump", 2, 1],
      ["Weighted RMS", 1, 1.1],
    ]);
  });

  it("leaves room for rounding", () => {
    const { differences } = compareRuns(
      run({ lv: summary(0, true, 1) }),
      run({ lv: summary(1e-17, true, 1 + 1e-7) }),
      METRICS,
    );
    expect(differences).toEqual([]);
  });

  it("says which strategies cannot be compared", () => {
    const broken = { status: "failed", reason: "no solution", compute_ms: 1 } as Run["strategies"][string];
    const { failed, compared } = compareRuns(run({ lv: summary(1, true) }), run({ lv: broken }), METRICS);
    expect(failed).toEqual(["lv: computed then, failed (no solution) now"]);
    expect(compared).toBe(0);
  });
});
