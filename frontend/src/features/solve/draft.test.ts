import { describe, expect, it } from "vitest";
import type { Metric } from "../../server/metrics";
import type { NumberField } from "../../scenario/schema";
import { otherField, readDraft, type SolveDraft, translateUnits } from "./SolveDialog";

const FIELD = {
  kind: "number",
  integer: false,
  unit: "m",
  minimum: -1,
  maximum: 1,
  exclusiveMinimum: false,
  soft: [0, 0.2],
  shown: { unit: "cm", scale: 100 },
} as unknown as NumberField;
const LOAD: Metric = {
  key: "bump.front_tyre_load.peak",
  label: "Front tyre dynamic load",
  group: "Peak, bump",
  unit: "kN",
  scale: 1e-3,
};
const DRAFT: SolveDraft = {
  field: "road.bump.height",
  from: "5",
  to: "0,2 m",
  strategy: "lv",
  metric: LOAD.key,
  limit: "4.5",
  roads: "3",
};

describe("a question as it is typed", () => {
  it("is asked in SI units", () => {
    const { question } = readDraft(DRAFT, FIELD, LOAD);
    expect(question).toEqual({
      field: "road.bump.height",
      strategy: "lv",
      metric: LOAD.key,
      range: [0.05, 0.2],
      limit: 4500,
      roads: 3,
    });
  });

  it("is about the requirements of its strategy, in place of a limit", () => {
    const requirements = [
      { metric: LOAD.key, max: 4500 },
      { metric: LOAD.key, max: 1, strategies: ["lqr"] },
    ];
    const of = (all: typeof requirements) => readDraft(DRAFT, FIELD, { requirements: all, baseline: "passive" });
    expect(of(requirements).question).toEqual({
      field: "road.bump.height",
      strategy: "lv",
      requirements: [requirements[0]],
      baseline: "passive",
      range: [0.05, 0.2],
      roads: 3,
    });
    expect(of(requirements.slice(1)).wrong.limit).toBe("None of the lab’s requirements is about this strategy");
  });

  it("says what is missing or wrong at the field", () => {
    const wrong = (change: Partial<SolveDraft>) => readDraft({ ...DRAFT, ...change }, FIELD, LOAD).wrong;
    expect(readDraft({ ...DRAFT, limit: " " }, FIELD, LOAD)).toEqual({
      question: null,
      driven: { range: [0.05, 0.2], roads: 3 },
      wrong: { limit: "Enter the limit in kN" },
    });
    expect(wrong({ limit: "4 kg" })).toEqual({ limit: "Takes kN (also without a unit) or N" });
    expect(wrong({ to: "50 mm" })).toEqual({ from: "From has to be less than To" });
    expect(wrong({ to: "2 m" }).to).toContain("Must be from");
    expect(wrong({ roads: "51" })).toEqual({ roads: "A whole number from 1 to 50" });
  });
});

it("the service's warnings are in the names and units of the page", () => {
  const said = translateUnits(
    "Not every smaller value keeps the limit: 0.05 to 0.06 m exceed it. bump.front_tyre_load.peak is 6200 N at 0.08 m.",
    { name: "road.bump.height", title: "Height", section: "Bump", leaf: FIELD },
    LOAD,
  );
  expect(said).toBe(
    "Not every smaller value keeps the limit: 5 to 6\u00a0cm exceed it. Front tyre dynamic load, peak, bump is 6.2\u00a0kN at 8\u00a0cm.",
  );
});

it("An end of the range that was typed stays when another strategy is asked about", () => {
  const [target, initial] = [
    { field: "speed.target", from: "15", to: "60" },
    { field: "speed.initial", from: "30", to: "80" },
  ];
  expect(otherField({ ...target, from: "5" }, target, target)).toEqual({ ...target, from: "5" });
  expect(otherField({ ...target, from: "5" }, target, initial)).toEqual({
    field: "speed.initial",
    from: "5",
    to: "80",
  });
  expect(otherField(target, target, initial)).toEqual(initial);
});
