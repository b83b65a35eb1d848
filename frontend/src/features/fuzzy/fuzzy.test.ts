import { describe, expect, it } from "vitest";
import type { FuzzyAnswer, FuzzySet } from "../../api/types";
import { converted, FUNCTIONS, moved, pointsOf } from "./SetsEditor";
import {
  conclusions,
  ruleBaseOf,
  withConclusion,
  withNewSet,
  withoutRuleBase,
  withRuleBase,
  withSet,
} from "./ruleBase";

const set = (fn: string, ...corners: readonly number[]): FuzzySet => ({ name: "S", function: fn, corners });

describe("A point that is moved", () => {
  it("stops at its neighbours, which a triangle may reach and an S curve may not", () => {
    expect(moved(set("trimf", 0, 5, 10), 1, 12, 0.1).corners).toEqual([0, 10, 10]);
    expect(moved(set("trapmf", 0, 2, 4, 6), 2, 1, 0.1).corners).toEqual([0, 2, 2, 6]);
    expect(moved(set("smf", 2, 8), 0, 9, 0.1).corners).toEqual([7.9, 8]);
    expect(moved(set("pimf", 0, 2, 4, 6), 2, 1, 0.1).corners).toEqual([0, 2, 2, 6]);
  });

  it("changes a width where it stands beside a mean, on either side, and never to nothing", () => {
    expect(moved(set("gaussmf", 10, 2), 1, 13, 0.1).corners).toEqual([10, 3]);
    expect(moved(set("gauss2mf", 4, 1, 6, 1), 1, 2, 0.1).corners).toEqual([4, 2, 6, 1]);
    expect(moved(set("gauss2mf", 4, 1, 6, 1), 0, 7, 0.1).corners).toEqual([6, 1, 6, 1]);
    expect(moved(set("gbellmf", 2, 3, 10), 0, 9, 0.1).corners).toEqual([0.1, 3, 10]);
  });
});

it("A set by another function stays where it is, and has as many points as that function takes", () => {
  const x = Array.from({ length: 81 }, (_, index) => index);
  const triangle = x.map((at) => Math.max(0, 1 - Math.abs(at - 40) / 20));
  for (const [name, { arguments: all }] of Object.entries(FUNCTIONS)) {
    const other = converted(set("trimf", 20, 40, 60), name, x, triangle);
    expect(other.corners, name).toHaveLength(all.length);
    expect(Math.min(...pointsOf(other).map((point) => Math.abs(point.x - 40))), name).toBeLessThanOrEqual(11);
  }
  expect(converted(set("gaussmf", 40, 8.5), "trimf", x, triangle).corners).toEqual([20, 40, 60]);
});

const sets = (...names: readonly string[]) => names.map((name) => ({ ...set("trimf", 0, 1, 2), name }));
const variable = (...names: readonly string[]) => ({
  unit: "m",
  universe: [0, 80],
  sets: sets(...names),
  memberships: [],
});
const rule = (speed_error: string | null, distance: string | null, then: string) => ({
  if: { speed_error, distance },
  then,
});
const paper: FuzzyAnswer = {
  speed_error: variable("O", "S"),
  distance: variable("O"),
  torque: variable("O", "V"),
  rules: [rule("O", "O", "O"), rule("S", "O", "V"), rule("S", null, "V")],
  surface: { speed_error: [], distance: [], torque: [] },
};
const PAPER = withoutRuleBase({});

describe("A rule base that is edited", () => {
  it("writes out the part that changes alone, and the other input beside it", () => {
    const edited = withRuleBase(PAPER, ruleBaseOf(PAPER, paper), (base) => withNewSet(base, "distance", 80));
    expect(edited).toMatchObject({ fuzzy: { output: null, rules: null, inputs: { speed_error: sets("O", "S") } } });
    expect(ruleBaseOf(edited, paper).distance.map(({ name }) => name)).toEqual(["O", "new1"]);
    expect(withoutRuleBase(edited)).toEqual(PAPER);
  });

  it("has its rules follow a set's name, and drops those of a set that goes", () => {
    const base = ruleBaseOf(PAPER, paper);
    const [first = set("trimf", 0, 1, 2)] = base.speed_error;
    const renamed = withSet(base, "speed_error", 0, { ...first, name: "none" });
    expect(renamed.rules[0]).toEqual(rule("none", "O", "O"));
    expect(withSet(base, "torque", 1, null).rules).toEqual([rule("O", "O", "O")]);
    expect(withSet(base, "distance", 0, { ...first, name: "O" }).rules).toBe(base.rules);
  });

  it("takes one conclusion in a cell of the table, or none", () => {
    const [cell, any] = [
      { speed_error: "S", distance: "O" },
      { speed_error: null, distance: "O" },
    ];
    const base = { ...ruleBaseOf(PAPER, paper), rules: [...paper.rules, rule("S", "O", "O")] };
    expect(conclusions(base, cell)).toEqual(["V", "O"]);
    const one = withConclusion(base, cell, "O");
    expect(one.rules).toEqual([rule("O", "O", "O"), rule("S", "O", "O"), rule("S", null, "V")]);
    expect(conclusions(withConclusion(one, cell, null), cell)).toEqual([]);
    expect(withConclusion(one, any, "V").rules.at(-1)).toEqual(rule(null, "O", "V"));
  });
});
