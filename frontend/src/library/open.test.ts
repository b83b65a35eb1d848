import { expect, it } from "vitest";
import type { JsonObject } from "../api/types";
import { standardScenario } from "../editor/diff";
import { FORM } from "../editor/form.fixture";
import { setAt } from "../editor/path";
import { withItem } from "./open";

const paper = standardScenario(FORM);

it("A saved scenario takes the paper's value for a field that is newer, and loses one that is gone", () => {
  const saved: JsonObject = { road: { bump: { height: 0.2 }, colour: 3 }, mpc: { lag: 5 } };
  expect(withItem({}, { kind: "scenario", value: saved }, FORM)).toEqual(setAt(setAt(paper, "/road/bump/height", 0.2), "/mpc/lag", 5));
});

it("A saved road is driven to its end; the rest of the scenario stays", () => {
  const edited = setAt(paper, "/mpc/lag", 5);
  const opened = withItem(edited, { kind: "road", value: { id: "r", length: 80, bumps: [] } }, FORM);
  expect(opened).toEqual(setAt(setAt(edited, "/road/profile", "r"), "/road/length", 80));
});
