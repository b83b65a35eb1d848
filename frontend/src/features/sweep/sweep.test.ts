import { describe, expect, it } from "vitest";
import { FORM } from "../../scenario/form.fixture";
import { problemsByField } from "../jobForm/jobForm";
import { draftField, readDraft, spread, type FieldDraft, type SweepDraft } from "./draft";
import { sweepFields } from "../../scenario/fields";
import { sweepFieldName } from "./sweepForm";

const FIELDS = sweepFields(FORM);
const field = (name: string) => {
  const field = FIELDS.find((candidate) => candidate.name === name);
  if (!field) throw new Error(name);
  return field;
};
const number = (name: string) => {
  const { leaf } = field(name);
  if (leaf.kind !== "number") throw new Error(name);
  return leaf;
};
const drafted = (name: string, change: Partial<FieldDraft> = {}): FieldDraft => ({
  ...draftField(field(name)),
  ...change,
});
const draft = (change: Partial<SweepDraft>): SweepDraft => ({
  method: "grid",
  fields: [],
  samples: "100",
  seed: "0",
  strategies: ["lv"],
  ...change,
});

describe("the fields a sweep can name", () => {
  it("are all of the form, weights one by one", () => {
    expect(FIELDS.map(({ name, title, section }) => [name, title, section])).toEqual([
      ["road.seed", "Seed", "Road"],
      ["road.bump.shape", "Shape", "Road › Bump"],
      ["road.bump.height", "Height", "Road › Bump"],
      ["mpc.lag", "Bandwidth", "MPC"],
      ["mpc.force_weight", "R", "MPC"],
      ["mpc.weights.0", "Cruise: Body", "MPC"],
      ["mpc.weights.1", "Cruise: Pitch", "MPC"],
    ]);
  });

  it("start with their soft range", () => {
    expect(drafted("road.bump.height")).toMatchObject({ from: "-15", to: "20", count: "5" });
    expect(drafted("road.bump.shape").options).toEqual(["cosine", "flat_top"]);
  });
});

describe("values from here to there", () => {
  it("are evenly spread, without the dust of binary fractions", () => {
    expect(spread(number("road.bump.height"), 0.05, 0.15, 5)).toEqual([0.05, 0.075, 0.1, 0.125, 0.15]);
  });

  it("have equal ratios where the field spans decades", () => {
    expect(spread(number("mpc.force_weight"), 1e-10, 1e-8, 3)).toEqual([1e-10, 1e-9, 1e-8]);
  });

  it("are whole where they must be, each once", () => {
    expect(spread(number("road.seed"), 1, 3, 9)).toEqual([1, 2, 3]);
  });
});

describe("what is sent", () => {
  it("is a grid of steps, lists and choices", () => {
    const fields = [
      drafted("road.bump.height", { from: "0", to: "10", count: "3" }),
      drafted("road.seed", { by: "list", list: "1, 2; 5" }),
      drafted("road.bump.shape", { options: ["flat_top"] }),
    ];
    expect(readDraft(draft({ fields }))).toEqual({
      ok: true,
      body: { grid: { "road.bump.height": [0, 0.05, 0.1], "road.seed": [1, 2, 5], "road.bump.shape": ["flat_top"] } },
    });
  });

  it("reads lists as people type them", () => {
    const list = (text: string) =>
      readDraft(draft({ fields: [drafted("road.bump.height", { by: "list", list: text })] }));
    for (const text of ["5 10", "5,10", "5, 10", "5;10", "5\n10,", "5 cm, 100mm", "5 cm 0.1 m"]) {
      expect(list(text), text).toEqual({ ok: true, body: { grid: { "road.bump.height": [0.05, 0.1] } } });
    }
  });

  it("is a Latin hypercube of ranges", () => {
    const fields = [drafted("road.bump.height"), drafted("mpc.weights.0")];
    expect(readDraft(draft({ method: "hypercube", fields, samples: "500", seed: "7" }))).toEqual({
      ok: true,
      body: {
        latin_hypercube: {
          ranges: { "road.bump.height": [-0.15, 0.2], "mpc.weights.0": [0, 10] },
          samples: 500,
          seed: 7,
        },
      },
    });
  });

  it("is nothing while a field cannot be used, and the field says why", () => {
    const fields = [
      drafted("road.bump.height", { from: "10", to: "3 m" }),
      drafted("road.seed", { by: "list", list: "1, x" }),
      drafted("mpc.lag", { from: "9", to: "2" }),
      drafted("mpc.force_weight", { count: "0" }),
      drafted("road.bump.shape", { options: [] }),
    ];
    expect(readDraft(draft({ fields, strategies: [] }))).toEqual({
      ok: false,
      errors: {
        strategies: "Choose at least one strategy",
        "road.bump.height": "To: must be from −100 to 100\u00a0cm",
        "road.seed": "x: enter a number, e.g. 0.12; no commas for thousands",
        "mpc.lag": "From has to be less than To",
        "mpc.force_weight": "Values: a whole number from 1 to 10000",
        "road.bump.shape": "Choose at least one",
      },
    });
    expect(
      readDraft(draft({ method: "hypercube", fields: [drafted("road.bump.shape")], samples: "1.5" })),
    ).toMatchObject({
      ok: false,
      errors: {
        "road.bump.shape": expect.stringContaining("grid") as string,
        samples: expect.stringContaining("whole") as string,
      },
    });
  });
});

describe("errors of the server", () => {
  it("stand at their field", () => {
    const errors = [
      { pointer: "/sweep/grid/road.bump.height/1", message: "too high" },
      { pointer: "/sweep/latin_hypercube/ranges/mpc.lag", message: "no range" },
      { pointer: "/sweep/latin_hypercube/samples", message: "too many" },
      { pointer: "/strategies/0", message: "unknown" },
      { pointer: "/sweep", message: "over the limit" },
      { pointer: "/scenario/road/length", message: "too short" },
    ];
    expect(problemsByField(errors, sweepFieldName(["road.bump.height", "mpc.lag"]), "")).toEqual({
      fields: { "road.bump.height": "too high", "mpc.lag": "no range", samples: "too many", strategies: "unknown" },
      general: ["over the limit", "The scenario’s road.length: too short"],
    });
    expect(problemsByField([], sweepFieldName([]), "Full").general).toEqual(["Full"]);
  });
});
