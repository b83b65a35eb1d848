import { describe, expect, it } from "vitest";
import { paperScenarioOf } from "../../scenario/differences";
import { FORM } from "../../scenario/form.fixture";
import { setAt } from "../../scenario/path";
import { parseSearch, stringifySearch } from "../../lab/address";
import { readScenarioSource } from "./scenarioSource";
import { otherThanPaper } from "./ScenarioChoice";

describe("where a page's scenario comes from", () => {
  it("is a run before one of the library, and that before a preset", () => {
    expect(readScenarioSource({ preset: "p", own: "My car", run: "R" })).toEqual({ run: "R" });
    expect(readScenarioSource({ preset: "p", own: "My car" })).toEqual({ own: "My car" });
    expect(readScenarioSource({ preset: "p", run: "R" })).toEqual({ run: "R" });
    expect(readScenarioSource({ preset: "p", run: "" })).toEqual({ preset: "p" });
  });

  it.each(["", "?run=a%26b", "?own=My+car", "?preset=half"])("stands in the address: %s", (search) => {
    expect(stringifySearch(readScenarioSource(parseSearch(search)))).toBe(search);
  });
});

describe("what differs from the paper", () => {
  const paper = paperScenarioOf(FORM);
  const changed = setAt(setAt(paper, "/road/bump/height", -0.06), "/mpc/weights/1", 3);

  it("is told field by field", () => {
    expect(otherThanPaper(paper, FORM)).toBe("As in the paper.");
    expect(otherThanPaper(changed, FORM)).toBe("Other than the paper: Bump height −6\u00a0cm, MPC cruise, pitch 3.");
  });

  it("names a measured road", () => {
    const profile = {
      kind: "text",
      pointer: "/road/profile",
      title: "Profile",
      description: "",
      paperValue: null,
    } as const;
    const form = { ...FORM, members: [...FORM.members, profile] };
    expect(otherThanPaper(setAt(paper, "/road/profile", "A".repeat(22)), form)).toBe(
      "Other than the paper: Profile a measured road.",
    );
  });

  it("leaves out what is swept", () => {
    expect(otherThanPaper(changed, FORM, ["road.bump.height", "mpc.weights"])).toBe("Everything else as in the paper.");
  });
});
