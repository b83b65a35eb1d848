import { expect, it, onTestFinished } from "vitest";
import { ACTION_IDS, ACTIONS, isKeyOn, letterKeys } from "./actions";

it("No two actions have a key or a name in common", () => {
  const keys = ACTION_IDS.flatMap((id) => ACTIONS[id].keys ?? []);
  const labels = ACTION_IDS.map((id) => ACTIONS[id].label);
  expect(keys.length).toBeGreaterThan(5);
  expect(new Set(keys).size).toBe(keys.length);
  expect(new Set(labels).size).toBe(labels.length);
});

it("Keys of one letter can be switched off", () => {
  const keys = ACTION_IDS.flatMap((id) => ACTIONS[id].keys ?? []);
  onTestFinished(() => letterKeys.set(true));
  expect(keys.every(isKeyOn)).toBe(true);
  letterKeys.set(false);
  expect(keys.filter((each) => !isKeyOn(each))).toEqual(["W", "P", "D", "S", "B", "A", "X"]);
});
