import { describe, expect, it } from "vitest";
import type { Catalogue, Caution, Comparison, Run, Strategy, Summary } from "../../api/types";
import { fromRun, type Result } from "../../lab/result";
import { baselineOf } from "../../lab/resultView";
import type { Labels } from "../../server/useCatalogues";
import { possibleBaselines } from "../compare/CompareBar";
import { changedMost, editChanges, shownComparison, speedsDiffer, whyNoComparison } from "./VerdictLine";

const SIGNALS = ["body_acceleration", "pitch_acceleration"];
const CATALOGUE = {
  paper_signals: SIGNALS,
  signals: SIGNALS.map((key) => ({ key, label: key === "body_acceleration" ? "Body acceleration" : "Pitch" })),
  unit: () => ({ unit: "", scale: 1 }),
} as unknown as Catalogue & Pick<Labels, "unit">;
const [LV, LQR, PASSIVE] = (["LV", "LQR", "Passive"] as const).map(
  (label) => ({ id: label.toLowerCase(), label, one_road_resolution: { rms: 7, peak: 15 } }) as unknown as Strategy,
) as [Strategy, Strategy, Strategy];
const ALL = [LV, LQR, PASSIVE];

/** Of both signals: RMS on the rough road, peak on the bump. */
const summary = ([bodyRms, pitchRms, bodyPeak, pitchPeak]: readonly number[], arrival_speed_kmh: number) =>
  ({
    arrival_speed_kmh,
    metrics: {
      rough_road: { body_acceleration: { rms: bodyRms }, pitch_acceleration: { rms: pitchRms } },
      bump: { body_acceleration: { peak: bodyPeak }, pitch_acceleration: { peak: pitchPeak } },
    },
  }) as unknown as Summary;

function compared(summaries: Readonly<Record<string, Summary>>) {
  const shown = { runId: "now", source: "exact", over: null, summaries, scenario: {} } as unknown as Result;
  return { shown, summaries, strategies: ALL.filter(({ id }) => id in summaries) };
}

describe("the baseline", () => {
  const { summaries, shown } = compared({ lv: summary([1, 1, 1, 1], 20), passive: summary([2, 2, 2, 2], 20) });
  const result = {
    source: "exact" as const,
    summaries,
    failed: [{ strategy: "lqr", message: "no controller" }],
    comparison: { baseline: "lv" } as unknown as Result["comparison"],
  };

  it("stays the one that was chosen, shown or hidden or failed, and else is the service's", () => {
    expect(["passive", "lqr", "skyhook"].map((chosen) => baselineOf(result, chosen))).toEqual(["passive", "lqr", "lv"]);
    const drive = "recording:one"; // nothing simulates it under a moving slider
    expect([baselineOf({ ...result, source: "live" }, drive), baselineOf(result, drive)]).toEqual([drive, "lv"]);
  });

  it("can be chosen of all that the result has, and says where it is not shown", () => {
    const labels = (baseline: string) =>
      possibleBaselines({ catalogue: ALL, ids: ["lv"], baseline, summaries, shown }).map(({ label }) => label);
    expect(labels("passive")).toEqual(["LV", "Passive (hidden)"]);
    expect(labels("lqr")).toEqual(["LV", "LQR (failed)", "Passive (hidden)"]);
  });
});

describe("the comparison before", () => {
  const [now, comparison] = [{ scenario: { road: 1 }, baseline: "passive", isAsked: true }, {} as Comparison];
  const last = { comparison, scenario: { road: 1 }, baseline: "passive" };

  it("is shown while that of the same scenario and baseline is on its way, and else none", () => {
    expect(shownComparison(undefined, last, now)).toEqual({ comparison, isOlder: true });
    const others = [
      { ...now, isAsked: false }, // refused, offline, or nothing to ask: a moving slider
      { ...now, scenario: { road: 2 } },
      { ...now, baseline: "recording:one" },
    ];
    for (const other of others)
      expect(shownComparison(undefined, last, other)).toEqual({ comparison: undefined, isOlder: false });
    expect(shownComparison(comparison, last, now)).toEqual({ comparison, isOlder: false });
  });

  it("with a recorded drive comes with the exact run, which is said", () => {
    const shown = (source: string) => ({ source }) as unknown as Result;
    const catalogue = [...ALL, { ...PASSIVE, id: "recording:one", label: "drive.csv" }];
    const text = (source: string, baseline: string) => whyNoComparison({ shown: shown(source), baseline, catalogue });
    expect(text("live", "recording:one")).toBe("The comparison with drive.csv comes with the exact run.");
    expect([text("exact", "recording:one"), text("live", "passive")]).toEqual(["", ""]);
  });
});

it("A result is cautioned as its comparison is: of the vehicle and of another core's strategies", () => {
  const cautions = ["paper_sag", "core_version"].map((kind) => ({ kind, text: kind }) as Caution);
  const run = { strategies: {}, comparison: { cautions } } as unknown as Run;
  expect(fromRun(run, { series: {}, missing: null }, 0, true).cautions).toEqual(cautions);
});

it("Speeds differ where strategies do not meet the bump alike", () => {
  const at = (...speeds: readonly number[]) =>
    speedsDiffer(
      compared(Object.fromEntries(speeds.map((speed, index) => [ALL[index]?.id ?? "", summary([], speed)]))),
    );
  expect([at(22.5, 22.5, 50), at(22.4, 22.5), at(20)]).toEqual([true, false, false]);
});

it("An edit's changes are each strategy's own, first those of the one that it moved", () => {
  const now = compared({ lv: summary([1, 1, 1, 1], 20), passive: summary([2, 2, 2, 2], 20) });
  const old = compared({ lv: summary([1, 1, 1, 1], 20), passive: summary([4, 2.1, 2, 1], 20) });
  const changes = editChanges(now, { name: "before the last edit", shown: old.shown }, CATALOGUE, undefined);
  expect(changes.map(({ change }) => change?.verdict)).toEqual([
    ...Array<string>(4).fill("same"),
    "better",
    "random",
    "same",
    "worse",
  ]);
  expect(changedMost(changes, now.strategies)).toBe(PASSIVE);
});
