import { expect, test } from "vitest";
import type { Group } from "./schema";
import { readVehicleFile, standardVehicle, vehicleFile } from "./vehicleFile";

const number = (name: string, standard: number) =>
  ({ kind: "number", pointer: `/vehicle/${name}`, title: name, description: "", standard, integer: false, nullable: false, unit: "kg", shown: { unit: "kg", scale: 1 }, minimum: 0, maximum: 9, exclusiveMinimum: false, soft: [0, 1] }) as const;
const FORM: Group = { kind: "group", pointer: "/vehicle", title: "Vehicle", description: "", members: [number("body_mass", 3), number("cg_height", 2)] };

test("a vehicle, a scenario and a run hold one, and what is left out is the paper's", () => {
  expect(standardVehicle(FORM)).toEqual({ body_mass: 3, cg_height: 2 });
  const whole = { body_mass: 5, cg_height: 2 };
  expect(readVehicleFile('{"label": "x", "vehicle": {"body_mass": 5}}', FORM)).toEqual(whole);
  expect(readVehicleFile('{"id": "r", "scenario": {"vehicle": {"body_mass": 5}}}', FORM)).toEqual(whole);
  expect(readVehicleFile(vehicleFile(whole, "x"), FORM)).toEqual(whole);
});

test.each([
  ["{", "not JSON"],
  ["[1]", "no member vehicle"],
  ['{"vehicle": 3}', "no member vehicle"],
  ['{"vehicle": {"colour": 1}}', "Unknown field colour; there are body_mass, cg_height"],
])("%s is refused and says why", (text, why) => {
  expect(() => readVehicleFile(text, FORM)).toThrow(why);
});
