import { createElement } from "react";
import { renderToString } from "react-dom/server";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { FORM } from "../scenario/form.fixture";
import { draftStudy, restoreStudy } from "../pages/robustness/study";
import { draftField, restoreSweep, type SweepDraft } from "../features/sweep/draft";
import { sweepFields } from "../scenario/fields";
import { firstDraft, limitOf, objectiveOf, restoreTuning } from "../pages/tuner/draft";
import { memoryStorage } from "./storage.fixture";
import { isLike, readStored, writeStored } from "./storage";
import { restoreDraft, useDraft, type Draft } from "./useDraft";

const FIELDS = sweepFields(FORM);
const [first] = FIELDS.filter(({ leaf }) => leaf.kind === "number").map(draftField);
const again = (value: unknown): unknown => JSON.parse(JSON.stringify(value));

describe("what the browser stores", () => {
  const openTab = () => void vi.stubGlobal("sessionStorage", memoryStorage());
  beforeEach(() => void vi.stubGlobal("localStorage", memoryStorage()));
  beforeEach(openTab);
  afterEach(() => void vi.unstubAllGlobals());

  it("is read again until it is removed, and ignored where it cannot be read", () => {
    writeStored("a", { x: 1 });
    expect(readStored("a")).toEqual({ x: 1 });
    writeStored("a", null);
    localStorage.setItem("b", "{");
    expect([readStored("a"), readStored("b")]).toEqual([null, null]);
  });

  it("is a form's only where it is of the same thing", () => {
    localStorage.setItem("ridelab-draft-changed-study", JSON.stringify({ of: "A", draft: 7 }));
    const of = (id: string) => restoreDraft({ name: "changed study", of: id, restore: (stored) => stored });
    expect([of("A"), of("B")]).toEqual([7, null]);
  });

  const open = () => {
    let opened: Draft<{ readonly seed: number }> | undefined;
    const Form = () =>
      void (opened = useDraft({
        name: "tuning",
        initial: () => ({ seed: 0 }),
        restore: (stored) => (isLike({ seed: 0 }, stored) ? stored : null),
      }));
    renderToString(createElement(Form));
    if (!opened) throw new Error("not rendered");
    return opened;
  };

  it("stays where a form was edited after it was submitted", () => {
    open().patch({ seed: 7 });
    const submitted = open();
    open().patch({ seed: 8 });
    submitted.forget();
    expect(open()).toMatchObject({ draft: { seed: 8 }, isEdited: true });
    open().forget();
    expect(open()).toMatchObject({ draft: { seed: 0 }, isEdited: false });
  });

  it("is a tab's own, and what a new tab begins with", () => {
    open().patch({ seed: 7 });
    const here = sessionStorage;
    openTab();
    expect(open().draft).toEqual({ seed: 7 });
    open().patch({ seed: 8 });
    vi.stubGlobal("sessionStorage", here);
    expect(open().draft).toEqual({ seed: 7 });
    open().forget();
    expect(open()).toMatchObject({ draft: { seed: 0 }, isEdited: false });
    openTab();
    expect(open().draft).toEqual({ seed: 8 });
  });
});

it("a stored value may have another shape than today's", () => {
  expect([
    isLike({ a: [{ b: "" }] }, { a: [{ b: "x" }], c: 1 }),
    isLike({ a: [""] }, { a: [1] }),
    isLike({ a: "" }, null),
    isLike(["", ""], ["x"]),
  ]).toEqual([true, false, false, false]);
});

describe("a stored draft", () => {
  it("of a sweep has the form's own fields, and none the form has no more", () => {
    if (!first) throw new Error("no fields");
    const gone = { ...first, field: { ...first.field, name: "nobody.knows" } };
    const draft: SweepDraft = {
      method: "hypercube",
      fields: [{ ...first, from: "7" }, gone],
      samples: "9",
      seed: "1",
      strategies: ["lv"],
    };
    const restored = restoreSweep(again(draft), FIELDS);
    expect(restored).toEqual({ ...draft, fields: draft.fields.slice(0, 1) });
    expect(restored?.fields[0]?.field).toBe(first.field);
    expect(restoreSweep({ ...draft, fields: [{ field: "height" }] }, FIELDS)).toBeNull();
  });

  it("of a study has the texts of the fields that are proposed", () => {
    const opening = draftStudy(
      {
        ranges: [{ field: "road.bump.height", title: "", unit: "m", low: 0, high: 0.1, why: "new" }],
        samples: 200,
        strategies: ["lv"],
        baseline: "lv",
        figures: [],
      },
      FORM,
    );
    const edited = {
      ...opening,
      samples: "50",
      ranges: opening.ranges.map((range) => ({ ...range, why: "old", to: "12", on: false })),
    };
    expect(restoreStudy(again(edited), opening)).toEqual({
      ...edited,
      ranges: [{ ...opening.ranges[0], to: "12", on: false }],
    });
    expect(restoreStudy({ samples: 50 }, opening)).toBeNull();
  });

  it("of a tuning is as it was, unless it is none", () => {
    const draft = {
      ...firstDraft(FORM),
      limits: [limitOf("bump.load.peak")],
      objectives: [objectiveOf(3, "figure", "travel")],
      trials: "many",
    };
    expect(restoreTuning(again(draft), FORM)).toEqual(draft);
    expect([
      restoreTuning({ ...draft, strategy: "passive" }, FORM),
      restoreTuning({ ...draft, seeds: 4 }, FORM),
      restoreTuning(null, FORM),
    ]).toEqual([null, null, null]);
  });
});
