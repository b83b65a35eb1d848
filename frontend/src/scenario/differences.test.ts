import { describe, expect, it } from "vitest";
import { FORM } from "./form.fixture";
import { changedFields, changedPointers, nameByChanges, paperScenarioOf, valueAt, withoutGone } from "./differences";
import { readSchema, type ScenarioSchema } from "./schema";
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

const DAMPING = { title: "Damping", type: "number", minimum: 0, maximum: 9000, default: 2000, unit: "N·s/m" };
const WITH_OWN = readSchema({
  properties: { own: { $ref: "#/$defs/Own", title: "Own controllers", default: {} } },
  $defs: {
    Own: { properties: { mine: { $ref: "#/$defs/own.mine" } } },
    "own.mine": { title: "Mine", properties: { damping: DAMPING } },
  },
});

describe("options of controllers of one's own", () => {
  it("are at their defaults where a scenario lacks them", () => {
    expect(valueAt({ own: {} }, { pointer: "/own/mine/damping", paperValue: 2000 })).toBe(2000);
    expect(changedPointers({ own: {} }, WITH_OWN)).toEqual([]);
    expect(changedPointers({ own: { mine: { damping: 3000 } } }, WITH_OWN)).toEqual(["/own/mine/damping"]);
  });

  it("are left out of what is sent once their controller is gone", () => {
    const scenario = { road: { seed: 1 }, own: { mine: { damping: 3000, gone: 1 }, other: { gain: 2 } } };
    expect(withoutGone(WITH_OWN, scenario)).toEqual({ road: { seed: 1 }, own: { mine: { damping: 3000 } } });
    expect(withoutGone(null, scenario)).toBe(scenario);
  });
});
