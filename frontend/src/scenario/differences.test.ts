import { expect, it } from "vitest";
import { FORM } from "./form.fixture";
import { changedFields, nameByChanges, paperScenarioOf } from "./differences";
import type { ScenarioSchema } from "./schema";
import { setAt } from "./path";

const PROFILE = {
  kind: "text",
  pointer: "/road/profile",
  title: "Profile",
  description: "",
  paperValue: null,
} as const;
const WITH_ROADS: ScenarioSchema = { ...FORM, members: [...FORM.members, PROFILE] };
const NONE = paperScenarioOf(WITH_ROADS);
const on = (id: string) => setAt(NONE, "/road/profile", id);
const changes = (from: typeof NONE, to: typeof NONE) =>
  changedFields(WITH_ROADS, from, to).map(({ name, change }) => `${name} ${change}`);

it("a list names a measured road in words, never by its id", () => {
  expect(changes(NONE, on("A".repeat(22)))).toEqual(["Profile none → a measured road"]);
  expect(changes(on("A".repeat(22)), on("B".repeat(22)))).toEqual(["Profile a measured road → another"]);
});

it("a pin is named by its own values of what differs", () => {
  const changes = ["Bump height", "Initial speed"].map((name, index) => ({
    pointer: "/" as const,
    name,
    change: "",
    value: index === 0 ? "12 cm" : "40 km/h",
  }));
  expect(nameByChanges(changes)).toBe("Bump height 12 cm, initial speed 40 km/h");
});
