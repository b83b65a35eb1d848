import { leadSentence } from "./StudyResults";
import { describe, expect, it } from "vitest";
import type { Batch, RobustnessDefaults } from "../../api/types";
import { FORM } from "../../scenario/form.fixture";
import { isOneByOne, tornadoOf } from "./charts";
import { fieldText } from "./RunButton";
import { draftStudy, readStudy, type StudyDraft, matters, quantile, ranked, type Sensitivity } from "./study";
import { withFields } from "../../scenario/fields";

const range = (field: string, low: number, high: number) => ({ field, title: field, unit: "1", low, high, why: "" });
const DEFAULTS: RobustnessDefaults = {
  ranges: [range("road.bump.height", 0.05, 0.15), range("road.seed", 1, 9), range("nobody.knows", 0, 1)],
  samples: 200,
  strategies: ["lv", "passive"],
  baseline: "lv",
  figures: [],
};
const batchOf = (sweep: object) => ({ strategies: ["lqr"], sweep, fields: [] }) as unknown as Batch;

it("a field's value is told in the unit its form has", () => {
  expect(["road.bump.height", "road.seed", "nobody.knows"].map((name) => fieldText(FORM, name, 0.07))).toEqual([
    "7\u00a0cm",
    "0.07",
    "0.07",
  ]);
});

describe("a study", () => {
  it("is what the server proposes, without fields this form has not", () => {
    const draft = draftStudy(DEFAULTS, FORM);
    expect(draft.ranges.map(({ field, from, to, on }) => [field.name, from, to, on])).toEqual([
      ["road.bump.height", "5", "15", true],
      ["road.seed", "1", "9", true],
    ]);
    expect(readStudy(draft)).toEqual({
      ok: true,
      body: {
        cube: {
          latin_hypercube: { ranges: { "road.bump.height": [0.05, 0.15], "road.seed": [1, 9] }, samples: 200, seed: 0 },
        },
        // A seed has no ends.
        oneByOne: { list: [{}, { "road.bump.height": 0.05 }, { "road.bump.height": 0.15 }] },
      },
    });
  });

  it("begins from one that was made, with fields nobody proposed", () => {
    const draft = draftStudy(
      DEFAULTS,
      FORM,
      batchOf({ latin_hypercube: { ranges: { "road.seed": [3, 9], "mpc.lag": [2, 9] }, samples: 50, seed: 4 } }),
    );
    expect(draft.ranges.map(({ field, from, on }) => [field.name, from, on])).toEqual([
      ["road.bump.height", "5", false],
      ["road.seed", "3", true],
      ["mpc.lag", "2", true],
    ]);
    expect(draft).toMatchObject({ samples: "50", seed: "4", strategies: ["lqr"] });
  });

  it("of nothing, of wrong ends or of too few samples is refused with the reason", () => {
    const draft = draftStudy(DEFAULTS, FORM);
    const change = (part: Partial<StudyDraft>) => readStudy({ ...draft, ...part });
    expect(change({ ranges: draft.ranges.map((each) => ({ ...each, on: false })) })).toEqual({
      ok: false,
      errors: { fields: "Nothing is uncertain: switch on at least one field" },
    });
    expect(change({ ranges: draft.ranges.map((each) => ({ ...each, from: "0.1", to: "0.02" })) })).toMatchObject({
      ok: false,
      errors: { "road.bump.height": "From has to be less than To", "road.seed": "From: must be a whole number" },
    });
    expect(change({ samples: "19" })).toMatchObject({
      ok: false,
      errors: { samples: expect.stringContaining("at least 20") as string },
    });
    expect(change({ oneByOne: false })).toMatchObject({ ok: true, body: { oneByOne: null } });
  });
});

describe("each field alone", () => {
  const fields = [
    { name: "a", title: "A", unit: "1", linked_to: null },
    { name: "b", title: "B", unit: "1", linked_to: null },
  ];
  const batch = { ...batchOf({ list: [{}, { a: 1 }, { a: 2 }, { b: 1 }, { b: 2 }] }), fields } as Batch;
  const columns = {
    run: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9],
    strategy: ["lv", "lqr", "lv", "lqr", "lv", "lqr", "lv", "lqr", "lv", "lqr"],
    a: [0, 0, 1, 1, 2, 2, 0, 0, 0, 0],
    b: [0, 0, 0, 0, 0, 0, 1, 1, 2, 2],
    peak: [10, 1, 9, 1, 11, 1, 14, 1, null, 1],
  };

  it("has a bar for each field, the widest first, and no end where a run failed", () => {
    expect(isOneByOne(batch)).toBe(true);
    const tornado = tornadoOf(batch, columns, "lv", "peak");
    expect(tornado?.nominal).toBe(10);
    expect(tornado?.bars.map(({ field, low, high, span }) => [field.name, low, high, span])).toEqual([
      ["b", { row: 6, at: 1, value: 14 }, null, 4],
      ["a", { row: 2, at: 1, value: 9 }, { row: 4, at: 2, value: 11 }, 2],
    ]);
  });

  it("is nothing without the scenario's own value", () => {
    expect(tornadoOf(batch, columns, "passive", "peak")).toBeNull();
    expect(isOneByOne({ ...batch, ...batchOf({ list: [{ a: 1 }] }) })).toBe(false);
    expect(isOneByOne({ ...batch, ...batchOf({ grid: { a: [1] } }) })).toBe(false);
  });
});

describe("the summary", () => {
  const sensitivities = (field: string, effect: number, chance = 0): Sensitivity => ({
    field,
    effect,
    p_value: chance,
    spearman: -0.5,
  });

  it("has its quantiles by percentage", () => {
    expect(quantile({ quantiles: [0, 50, 100] }, { quantiles: [1, 2, 3] }, 50)).toBe(2);
    expect(quantile({ quantiles: [0, 50, 100] }, { quantiles: [1, 2, 3] }, 5)).toBeNull();
    expect(quantile({ quantiles: [0, 50, 100] }, { quantiles: null }, 50)).toBeNull();
  });

  it("ranks fields by the figure that follows them most", () => {
    const cells = ranked({ x: [sensitivities("a", 0.3), sensitivities("b", 0.1)], y: [sensitivities("b", 0.6)] });
    expect(cells.map(({ field, most, cells }) => [field, most, Object.keys(cells)])).toEqual([
      ["b", 0.6, ["x", "y"]],
      ["a", 0.3, ["x"]],
    ]);
  });

  it("tells what chance does not make", () => {
    expect([sensitivities("a", 0.2, 1e-4), sensitivities("a", 0.2, 0.002)].map(matters)).toEqual([true, false]);
  });
});

it("a place's scenario has its fields and shares the rest", () => {
  const base = { road: { seed: 1, bump: { height: 0.1 } }, mpc: { lag: null } };
  const there = withFields(base, { "road.seed": 7, "mpc.lag": 12 });
  expect(there).toEqual({ road: { seed: 7, bump: { height: 0.1 } }, mpc: { lag: 12 } });
  expect((there.road as typeof base.road).bump).toBe(base.road.bump);
});

it("A lead is concluded in a sentence, what is behind included", () => {
  const leads = [
    { worse: 1, better: 0 },
    { worse: 0.7, better: 0.3 },
    { worse: 0.2, better: 0.8 },
  ];
  expect(leadSentence("LV", "LQR", leads)).toBe(
    "LV is better than LQR in 2 of 3 metrics at most points, in 1 at 95 % of them and more; worse in 1.",
  );
});
