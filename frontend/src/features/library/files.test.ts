import { expect, it, test } from "vitest";
import { FORM } from "../../scenario/form.fixture";
import { fileOf, readFile, roadOf, type Exported } from "./files";

const [ROAD, MPC] = FORM.members;
if (!ROAD || !MPC) throw new Error("no form");
const FORM_2 = { ...FORM, members: [{ ...ROAD, pointer: "/vehicle" as const }, ROAD, MPC], version: 2 };
const read = (text: string) => readFile(text, FORM_2);
const written = (item: Exported, road: string | null = null) => fileOf(item, 2, road);

it("Scenarios, runs and vehicles are told apart by their content", () => {
  const scenario = { road: { bump: { height: 0.12 } }, vehicle: { body_mass: 5 } };
  expect(read(JSON.stringify(scenario))).toEqual({ kind: "scenario", value: scenario, label: null, road: null });
  expect(read(JSON.stringify({ id: "r", scenario, strategies: {} }))).toMatchObject({
    kind: "scenario",
    value: scenario,
  });
  expect(read('{"label": "Van", "vehicle": {"body_mass": 5}}')).toEqual({
    kind: "vehicle",
    value: { body_mass: 5 },
    label: "Van",
  });
});

it("Requirements are a list, or have a name; exported they are read again, here and by --require", () => {
  const requirements = [{ metric: "travel_time", max: 20, strategies: ["lv"] }];
  const value = { requirements };
  expect(read(JSON.stringify(requirements))).toEqual({ kind: "requirements", value, label: null });
  const { text } = written({ kind: "requirements", name: "Mine", value });
  expect(JSON.parse(text)).toMatchObject(value);
  expect(read(text)).toEqual({ kind: "requirements", value, label: "Mine" });
  expect(() => read('[{"metric": "travel_time"}]')).toThrow("Expected a scenario");
});

it("What core 0.3.0 wrote opens with the filter it had, what a person wrote is today's", () => {
  const kalman = { kind: "kalman", acceleration_noise: 0.05, deflection_noise: 0.0005, pitch_rate_noise: 0.002 };
  const scenario = { road: {}, estimation: kalman };
  const had = { value: { road: {}, estimation: { ...kalman, knows_preview: false } } };
  expect(read(JSON.stringify({ schema_version: 1, scenario }))).toMatchObject(had);
  expect(read(JSON.stringify({ core_version: "0.3.0", scenario, strategies: {} }))).toMatchObject(had);
  expect(read(JSON.stringify(scenario))).toMatchObject(had);
  const typed = { road: {}, estimation: { kind: "kalman" } };
  expect(read(JSON.stringify(typed))).toMatchObject({ value: typed });
  expect(read(written({ kind: "scenario", name: "s", value: scenario }).text)).toEqual({
    kind: "scenario",
    value: scenario,
    label: "s",
    road: null,
  });
  expect(read('{"schema_version": 1, "vehicle": {"body_mass": 5}}')).toMatchObject({ kind: "vehicle" });
});

it("What is exported is read again", () => {
  const vehicle = written({ kind: "vehicle", name: "Van: 887/2 kg", value: { body_mass: 5 } });
  expect(vehicle.name).toBe("Van_ 887_2 kg.json");
  expect(read(vehicle.text)).toEqual({ kind: "vehicle", value: { body_mass: 5 }, label: "Van: 887/2 kg" });
  expect(read(written({ kind: "scenario", name: "s", value: { road: {} } }).text)).toEqual({
    kind: "scenario",
    value: { road: {} },
    label: "s",
    road: null,
  });
});

it("A scenario goes with the content of its measured road, and a road is its CSV", () => {
  const csv = "# Ridelab road A: 1\nheight [m]\n0.1\n";
  const item: Exported = { kind: "scenario", name: "Street", value: { road: { profile: "A" } } };
  expect(roadOf(item)).toBe("A");
  expect(roadOf({ ...item, value: { road: { profile: null } } })).toBeNull();
  expect(read(written(item, csv).text)).toEqual({ kind: "scenario", value: item.value, label: "Street", road: csv });
  const road: Exported = { kind: "road", name: "Main street", value: { id: "A", length: 180 } };
  expect(roadOf(road)).toBe("A");
  const file = written(road, csv);
  expect(file).toMatchObject({ name: "Main street.csv", type: "text/csv" });
  expect(file.text).toBe(csv);
});

it("A file of a newer version is refused, one of an older version and one without are read", () => {
  const file = (version: unknown) => JSON.stringify({ schema_version: version, scenario: { road: {} } });
  expect(() => read(file(3))).toThrow(
    "This file comes from a newer version of Ridelab: it has schema version 3, and this Ridelab reads up to 2.",
  );
  expect(() => read(file("new"))).toThrow("is not a number");
  expect(read(file(1))).toMatchObject({ kind: "scenario" });
  expect(read(written({ kind: "vehicle", name: "v", value: {} }).text)).toMatchObject({ kind: "vehicle" });
});

test.each([
  ["{", "not JSON"],
  ["no vehicle", "not JSON"],
  ["[1]", "Expected a scenario, a vehicle or requirements as JSON, or a measured road"],
  ['{"colour": 1}', "one of the members vehicle, road, mpc"],
])("%s is refused and says why", (text, why) => {
  expect(() => read(text)).toThrow(why);
});
