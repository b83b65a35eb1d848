import { expect, it } from "vitest";
import { ACTION_IDS, ACTIONS } from "./actions";

it("No two actions have a key or a name in common", () => {
  const keys = ACTION_IDS.flatMap((id) => ACTIONS[id].keys ?? []);
  const labels = ACTION_IDS.map((id) => ACTIONS[id].label);
  expect(keys.length).toBeGreaterThan(5);
  expect(new Set(keys).size).toBe(keys.length);
  expect(new Set(labels).size).toBe(labels.length);
});
