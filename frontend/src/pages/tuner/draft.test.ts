import { describe, expect, it } from "vitest";
import type { Metric } from "../../server/metrics";
import { problemsByField } from "../../features/jobForm/jobForm";
import { rangesFor, readDraft, restoreTuning, objectiveOf, tuningFieldName, type TuningDraft } from "./draft";
import { readSchema } from "../../scenario/schema";
import { withFields } from "../../scenario/fields";
import { formatValue, numberFields, ownText, singlesIn, tunableOf, weightAt } from "./space";

const TRAVEL: Metric = { key: "events.travel", label: "Travel", group: "Events", unit: "mm", scale: 1 };
const LOAD: Metric = { key: "bump.load.peak", label: "Load", group: "Peak, bump", unit: "kN", scale: 1e-3 };

const weight = { type: "number", minimum: 0, maximum: 1000 };
const FORM = readSchema({
  properties: {
    lqr: { properties: { weights: { title: "Weights", prefixItems: [weight, weight, weight], soft_range: [0, 10] } } },
    mpc: {
      properties: {
        expected_noise: {
          title: "Expected preview noise",
          type: "number",
          minimum: 0,
          maximum: 0.1,
          unit: "m",
          shown_unit: "mm",
          soft_range: [0, 0.005],
        },
      },
    },
  },
});
const NUMBERS = numberFields(tunableOf(FORM, "lqr"));

const DRAFT: TuningDraft = {
  strategy: "lqr",
  objectives: [objectiveOf(0, "paper"), objectiveOf(1, "figure", "bump.load.peak")],
  limits: [{ figure: "bump.load.peak", atMost: "4.2" }],
  ranges: { "lqr.weights.0": { on: true, from: "0,1", to: "10" }, "lqr.weights.1": { on: false, from: "x", to: "" } },
  previews: [],
  uncertain: false,
  quantile: "",
  seeds: "1-2",
  validationSeeds: "101, 102",
  trials: "40",
  population: "8",
  seed: "3",
};
const read = (change: Partial<TuningDraft> = {}) => readDraft({ ...DRAFT, ...change }, NUMBERS, [TRAVEL, LOAD]);
const errorsOf = (change: Partial<TuningDraft>) => {
  const parsed = read(change);
  return parsed.ok ? {} : parsed.errors;
};

describe("a draft of a tuning", () => {
  it("is sent in SI, without the weights that are held", () => {
    expect(read()).toEqual({
      ok: true,
      body: {
        strategy: "lqr",
        objectives: [
          { kind: "paper", q: [1, 1, 1], window: "whole" },
          { kind: "figure", figure: "bump.load.peak" },
        ],
        limits: [{ figure: "bump.load.peak", at_most: 4200 }],
        search: { "lqr.weights.0": [0.1, 10] },
        seeds: [1, 2],
        fresh_seeds: [101, 102],
        trials: 40,
        population: 8,
        seed: 3,
      },
    });
  });

  it("takes ranges in the units that the form shows, and with any other", () => {
    expect(rangesFor(FORM, "lqr")["mpc.expected_noise"]).toEqual({ on: false, from: "0.05", to: "5" });
    const parsed = read({ ranges: { "mpc.expected_noise": { on: true, from: "0.5", to: "0,2 cm" } } });
    expect(parsed.ok && parsed.body.search).toEqual({ "mpc.expected_noise": [0.0005, 0.002] });
    expect(errorsOf({ ranges: { "mpc.expected_noise": { on: true, from: "1", to: "101" } } })).toEqual({
      "search.mpc.expected_noise": "To: must be above 0 and at most 100\u00a0mm",
    });
    const noise = NUMBERS.find(({ name }) => name === "mpc.expected_noise");
    expect(
      noise && [noise.row, ownText({ mpc: { expected_noise: 0.003 } }, noise), formatValue(0.0025, noise.field)],
    ).toEqual(["Expected preview noise [mm]", "3\u00a0mm", "2.5"]);
  });

  it.each<[Partial<TuningDraft>, string]>([
    [{ objectives: [] }, "objectives"],
    [{ objectives: [{ ...objectiveOf(0, "peaks"), q: ["0", "0", "0"] }] }, "objectives.0"],
    [{ objectives: [objectiveOf(0, "paper"), { ...objectiveOf(1, "peaks"), q: ["1", "", "1"] }] }, "objectives.1"],
    [{ limits: [{ figure: "events.travel", atMost: "some" }] }, "limits.0"],
    [{ ranges: { "lqr.weights.0": { on: true, from: "5", to: "5" } } }, "search.lqr.weights.0"],
    [{ ranges: { "lqr.weights.0": { on: true, from: "0", to: "5" } } }, "search.lqr.weights.0"],
    [{ ranges: { "lqr.weights.0": { on: false, from: "1", to: "5" } } }, "search"],
    [{ seeds: "" }, "seeds"],
    [{ validationSeeds: "101" }, "fresh_seeds"],
    [{ validationSeeds: "2-9" }, "fresh_seeds"],
    [{ trials: "0" }, "trials"],
    [{ population: "1.5" }, "population"],
    [{ seed: "-1" }, "seed"],
  ])("%j is refused at %s", (change, field) => expect(Object.keys(errorsOf(change))).toEqual([field]));
});

describe("the server's errors", () => {
  it("stand at the field they are about", () => {
    const errors = [
      { pointer: "/objectives/1/figure", message: "a" },
      { pointer: "/search/lqr.weights.0/1", message: "b" },
      { pointer: "/fresh_seeds/0", message: "c" },
      { pointer: "/objectives", message: "d" },
      { pointer: "/scenario/road/length", message: "e" },
      { pointer: "", message: "f" },
    ];
    expect(problemsByField(errors, tuningFieldName, "x")).toEqual({
      fields: { "objectives.1": "a", "search.lqr.weights.0": "b", fresh_seeds: "c", objectives: "d" },
      general: ["The scenario’s road.length: e", "f"],
    });
    expect(problemsByField([], tuningFieldName, "x").general).toEqual(["x"]);
  });
});

describe("a trial's weights", () => {
  const weights = { "mpc.stage_weights.bump": [1, 2, 3], "mpc.deflection_weight": 4 };

  it("are read one by one", () => {
    expect(weightAt(weights, "mpc.stage_weights.bump.2")).toBe(3);
    expect(weightAt(weights, "mpc.deflection_weight")).toBe(4);
    expect(weightAt(weights, "mpc.stage_weights.brake.0")).toBeUndefined();
  });

  it("go into a scenario as they are", () => {
    const scenario = { mpc: { stage_weights: { bump: [0, 0, 0], brake: [9, 9, 9] }, deflection_weight: 0 } };
    expect(withFields(scenario, weights)).toEqual({
      mpc: { stage_weights: { bump: [1, 2, 3], brake: [9, 9, 9] }, deflection_weight: 4 },
    });
  });
});

describe("a law of one's own", () => {
  const options = {
    damping: { type: "number", minimum: 0, maximum: 20000, unit: "N·s/m", default: 2000, soft_range: [0, 20000] },
    gain: { type: "number", unit: "1", default: -1, soft_range: [-2, 2] },
    hard: { type: "boolean", default: false },
  };
  const form = readSchema({ properties: { own: { properties: { mine: { title: "Mine", properties: options } } } } });

  it("is tuned by its options that are numbers, those with bounds at first, on both sides of zero", () => {
    const ranges = rangesFor(form, "mine");
    expect(ranges).toEqual({
      "own.mine.damping": { on: true, from: "0", to: "20000" },
      "own.mine.gain": { on: false, from: "-2", to: "2" },
    });
    const searched = { ...ranges, "own.mine.gain": { on: true, from: "-1", to: "1" } };
    const tunable = tunableOf(form, "mine");
    expect(tunable.untuned).toEqual(["Hard"]);
    const numbers = numberFields(tunable);
    expect(numbers.map((each) => ownText({ own: { mine: { gain: 2 } } }, each))).toEqual(["2000\u00a0N·s/m", "2"]);
    const parsed = readDraft({ ...DRAFT, strategy: "mine", limits: [], ranges: searched }, numbers, []);
    expect(parsed.ok && parsed.body.search).toEqual({ "own.mine.damping": [0, 20000], "own.mine.gain": [-1, 1] });
    expect(restoreTuning({ ...DRAFT, strategy: "gone" }, form)).toBeNull();
  });

  it("shows what was tried of an option that it has no more", () => {
    const shown = singlesIn(tunableOf(form, "mine"), { "own.mine.damping": 2000, "own.mine.gone": 3 });
    expect(shown.map(({ title, field }) => [title, formatValue(3, field)])).toEqual([
      ["Damping [N·s/m]", "3"],
      ["gone", "3"],
    ]);
  });
});
