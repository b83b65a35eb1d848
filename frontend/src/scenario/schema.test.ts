import { describe, expect, it } from "vitest";
import {
  changedFields,
  changedPointers,
  changesText,
  completed,
  leavesOf,
  resetMember,
  paperScenarioOf,
} from "./differences";
import { FORM } from "./form.fixture";
import { foundIn, matching, sections } from "../features/editor/Editor";
import { parseTyped, sliderScale, stepped, typedText, typicalValue, valueText } from "./limits";
import { getAt, sameValue, setAt, type Pointer } from "./path";
import { readSchema, type NumberField } from "./schema";
import { fieldFor, errorsByField } from "./fields";

function numberField(pointer: Pointer): NumberField {
  const leaf = leavesOf(FORM).find((candidate) => candidate.pointer === pointer);
  if (leaf?.kind !== "number") throw new Error(`${pointer} is not a number`);
  return leaf;
}

const STANDARD = paperScenarioOf(FORM);

describe("the form from the schema", () => {
  it("reads every leaf in the schema's order", () => {
    expect(leavesOf(FORM).map(({ pointer }) => pointer)).toEqual([
      "/road/seed",
      "/road/bump/shape",
      "/road/bump/height",
      "/mpc/lag",
      "/mpc/force_weight",
      "/mpc/weights/0",
      "/mpc/weights/1",
    ]);
  });

  it("takes titles, units, limits and defaults from the schema", () => {
    expect(numberField("/road/bump/height")).toMatchObject({
      title: "Height",
      unit: "m",
      minimum: -1,
      maximum: 1,
      soft: [-0.15, 0.2],
      paperValue: 0.1,
    });
    expect(numberField("/mpc/weights/1")).toMatchObject({ title: "Pitch", minimum: 0, maximum: 1000, paperValue: 1 });
    expect(numberField("/mpc/lag")).toMatchObject({ nullable: true, minimum: 0.5, paperValue: null });
    expect(numberField("/road/seed").integer).toBe(true);
  });

  it("states the paper's scenario", () => {
    expect(STANDARD).toEqual({
      road: { seed: 1, bump: { shape: "cosine", height: 0.1 } },
      mpc: { lag: null, force_weight: 1e-9, weights: [8, 1] },
    });
  });
});

describe("data without a control", () => {
  const rules = {
    anyOf: [{ type: "array", items: { type: "object" } }, { type: "null" }],
    default: null,
    title: "Rules",
  };
  const inputs = { anyOf: [{ $ref: "#/$defs/Inputs" }, { type: "null" }], default: null, title: "Input sets" };
  const form = readSchema({
    $defs: { Inputs: { type: "object", properties: {} } },
    type: "object",
    properties: { rules, inputs },
  });
  const own = { rules: [{ if: { distance: "O" }, then: "V" }], inputs: null };

  it("is a field that is kept, counted as a change and reset", () => {
    expect(leavesOf(form).map(({ kind }) => kind)).toEqual(["data", "data"]);
    expect(completed(form, own)).toEqual(own);
    expect(changesText(changedFields(form, paperScenarioOf(form), own))).toBe("Rules none → own");
    expect(resetMember(own, form)).toEqual({ rules: null, inputs: null });
  });
});

describe("a search over all fields", () => {
  const names = (text: string) =>
    sections(FORM)
      .flatMap((section) => matching(section, text) ?? [])
      .flatMap(({ members }) => members.flatMap((member) => leavesOf(member).map(({ pointer }) => pointer)));

  it("finds by title, by part and by dotted name, every word", () => {
    expect(names("height")).toEqual(["/road/bump/height"]);
    expect(names("bump sh")).toEqual(["/road/bump/shape"]);
    expect(names("mpc.force")).toEqual(["/mpc/force_weight"]);
    expect(names("pitch")).toEqual(["/mpc/weights/0", "/mpc/weights/1"]);
    expect(names("bump banana")).toEqual([]);
  });

  it("finds by option, unit and help text what no name has", () => {
    const pointers = (text: string) =>
      foundIn(sections(FORM), text).flatMap(({ members }) =>
        members.flatMap((member) => leavesOf(member).map(({ pointer }) => pointer)),
      );
    expect(pointers("height")).toEqual(["/road/bump/height"]);
    expect(pointers("cosine")).toEqual(["/road/bump/shape"]);
    for (const unit of ["cm", "inch", "length"]) expect(pointers(unit)).toContain("/road/bump/height");
    expect(pointers("banana")).toEqual([]);
  });

  it("finds by the words that people have for a field, in singular and plural", () => {
    expect(names("pothole")).toEqual(["/road/bump/height"]);
    expect(names("humps")).toEqual(["/road/bump/height"]);
    expect(names("speed bump")).toEqual(["/road/bump/height"]);
    expect(names("speed")).toEqual([]);
    expect(names("frequencies")).toEqual(["/mpc/lag"]);
    expect(names("frequency mpc")).toEqual(["/mpc/lag"]);
    expect(names("comfort")).toEqual(["/mpc/weights/0", "/mpc/weights/1"]);
  });

  it("finds a section by what it offers", () => {
    const keys = (text: string) =>
      foundIn(sections(FORM), text, { "/road/bump": ["Watts hump, long"] }).map(({ key, members }) => [
        key,
        members.length,
      ]);
    expect(keys("long hump")).toEqual([["/road/bump", 0]]);
    expect(keys("hump banana")).toEqual([]);
  });
});

describe("difference from the paper", () => {
  it("is nothing for the paper's scenario", () => {
    expect(changedPointers(STANDARD, FORM)).toEqual([]);
  });

  it("counts the entries of a vector one by one and is undone by a reset", () => {
    const changed = setAt(setAt(STANDARD, "/mpc/weights/1", 6), "/road/bump/height", 0.12);
    expect(changedPointers(changed, FORM)).toEqual(["/road/bump/height", "/mpc/weights/1"]);
    expect(resetMember(changed, FORM)).toEqual(STANDARD);
  });

  it("changes one value and shares the rest", () => {
    const changed = setAt(STANDARD, "/road/bump/height", 0.2);
    expect(getAt(STANDARD, "/road/bump/height")).toBe(0.1);
    expect(changed.mpc).toBe(STANDARD.mpc);
    expect(sameValue(changed, STANDARD)).toBe(false);
    expect(sameValue(setAt(changed, "/road/bump/height", 0.1), STANDARD)).toBe(true);
  });
});

describe("difference between two scenarios", () => {
  const paper = paperScenarioOf(FORM);

  it("is told by the form's names and units", () => {
    const other = setAt(setAt(setAt(paper, "/road/bump/height", 0.12), "/mpc/lag", 8), "/mpc/weights/1", 2);
    const changes = changedFields(FORM, paper, setAt(other, "/road/bump/shape", "flat_top"));
    expect(changes.map(({ name, change }) => `${name} ${change}`)).toEqual([
      "Bump shape cosine → flat top",
      "Bump height 10 → 12\u00a0cm",
      "MPC bandwidth none → 8\u00a0Hz",
      "MPC cruise, pitch 1 → 2",
    ]);
    expect(changesText(changes, 2)).toBe("Bump shape cosine → flat top, Bump height 10 → 12\u00a0cm, 2 more");
    expect(changesText(changes, 3).endsWith("pitch 1 → 2")).toBe(true);
    expect(changedFields(FORM, other, other)).toEqual([]);
  });
});

describe("errors of the server", () => {
  it("land at their field, at the vector's first entry, or nowhere", () => {
    expect(fieldFor(FORM, "/scenario/road/bump/height")).toBe("/road/bump/height");
    expect(fieldFor(FORM, "/scenario/mpc/weights/1")).toBe("/mpc/weights/1");
    expect(fieldFor(FORM, "/scenario/mpc/weights")).toBe("/mpc/weights/0");
    expect(fieldFor(FORM, "/scenario/road/nothing")).toBeNull();
    expect(fieldFor(FORM, "/strategies")).toBeNull();
  });

  it("keep what belongs to no field", () => {
    const placed = errorsByField(
      FORM,
      [
        { pointer: "/scenario/road/seed", message: "a" },
        { pointer: "/scenario/road/seed", message: "b" },
        { pointer: "/strategies/0", message: "c" },
      ],
      "fallback",
    );
    expect(placed).toEqual({ fields: { "/road/seed": "a. b" }, general: ["c"] });
    expect(errorsByField(FORM, [], "fallback").general).toEqual(["fallback"]);
  });
});

describe("typed values", () => {
  it("are checked against the hard limits", () => {
    const height = numberField("/road/bump/height");
    expect(parseTyped(height, "12")).toEqual({ ok: true, value: 0.12 });
    expect(parseTyped(height, "120 mm")).toEqual({ ok: true, value: 0.12 });
    expect(parseTyped(height, "2 m")).toEqual({ ok: false, message: "Must be from −100 to 100\u00a0cm" });
    expect(parseTyped(height, "high").ok).toBe(false);
    expect(parseTyped(height, " ").ok).toBe(false);
    expect(parseTyped(numberField("/road/seed"), "1.5")).toEqual({ ok: false, message: "Must be a whole number" });
  });
});

it("values are typed and read in the unit they are shown in", () => {
  const height = numberField("/road/bump/height");
  expect([typedText(height, 0.07), valueText(height, -0.06), typedText(numberField("/road/seed"), 3)]).toEqual([
    "7",
    "−6\u00a0cm",
    "3",
  ]);
});

describe("steps by arrow keys", () => {
  it("are the slider's, and end at the hard limits", () => {
    const height = numberField("/road/bump/height");
    expect([
      stepped(height, 0.1, 1),
      stepped(height, 0.1, -10),
      stepped(height, 0.999, 10),
      stepped(height, 0.25, 1),
    ]).toEqual([0.102, 0.08, 1, 0.252]);
    expect(stepped(numberField("/mpc/force_weight"), 1e-9, 1)).toBe(1.1e-9);
    expect(stepped(numberField("/road/seed"), 1, 1)).toBe(2);
  });
});

describe("sliders", () => {
  it("count steps and give values without binary dust", () => {
    const scale = sliderScale(numberField("/road/bump/height"));
    expect(scale.fromSlider(scale.toSlider(0.1))).toBe(0.1);
    expect(scale.fromSlider(scale.toSlider(0.1) + 1)).toBe(0.102);
    expect(scale.fromSlider(scale.minimum)).toBe(-0.15);
  });

  it("go by ratio where the range spans decades", () => {
    const scale = sliderScale(numberField("/mpc/force_weight"));
    expect(scale.fromSlider(scale.toSlider(1e-9))).toBe(1e-9);
    expect(scale.fromSlider((scale.minimum + scale.maximum) / 2)).toBeCloseTo(3.2e-9, 12);
  });

  it("start a nullable field in the middle of its range", () => {
    expect(typicalValue(numberField("/mpc/lag"))).toBe(10);
  });
});
