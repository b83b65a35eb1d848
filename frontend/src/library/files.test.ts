import { expect, it, test } from "vitest";
import { fileOf, readFile } from "./files";

const PARTS = ["vehicle", "road", "mpc"];
const read = (text: string, name = "file.json") => readFile(name, text, PARTS);

it("Scenarios, runs, vehicles and roads are told apart by their content", () => {
  const scenario = { road: { bump: { height: 0.12 } }, vehicle: { body_mass: 5 } };
  expect(read(JSON.stringify(scenario))).toEqual({ kind: "scenario", value: scenario, label: null });
  expect(read(JSON.stringify({ id: "r", scenario, strategies: {} }), "run.txt")).toMatchObject({ kind: "scenario", value: scenario });
  expect(read('{"label": "Van", "vehicle": {"body_mass": 5}}')).toEqual({ kind: "vehicle", value: { body_mass: 5 }, label: "Van" });
  const csv = "distance [m];height [mm]\r\n0;0\r\n5;12\r\n";
  expect(read(csv, "street.csv")).toEqual({ kind: "road", csv });
  const commented = `# Measured in May\n\n${csv}`;
  expect(read(commented, "street.csv")).toEqual({ kind: "road", csv: commented });
});

it("What is exported is read again", () => {
  const vehicle = fileOf({ kind: "vehicle", name: "Van: 887/2 kg", value: { body_mass: 5 } });
  expect(vehicle.name).toBe("Van_ 887_2 kg.json");
  expect(read(vehicle.text)).toEqual({ kind: "vehicle", value: { body_mass: 5 }, label: "Van: 887/2 kg" });
  expect(read(fileOf({ kind: "scenario", name: "s", value: { road: {} } }).text)).toMatchObject({ kind: "scenario", value: { road: {} } });
});

test.each([
  ["{", "file.json", "not JSON"],
  ["no vehicle", "file.json", "not JSON"],
  ["[1]", "file.json", "Expected a scenario or a vehicle as JSON, or a measured road"],
  ['{"colour": 1}', "file.json", "one of the members vehicle, road, mpc"],
  ["Dear diary,\nit rains", "diary.txt", "Expected a scenario"],
  ["\u0000PNG", "photo.png", "Expected a scenario"],
])("%s in %s is refused and says why", (text, name, why) => {
  expect(() => read(text, name)).toThrow(why);
});
