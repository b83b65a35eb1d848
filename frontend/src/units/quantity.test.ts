import { describe, expect, it } from "vitest";
import { parseQuantity, shownIn, unitBehind } from "./quantity";

const value = (text: string, unit: string) => {
  const parsed = parseQuantity(text, unit);
  return parsed.ok ? parsed.value : parsed.message;
};

describe("a number as people write it", () => {
  it.each([
    ["12", "cm", 12],
    ["12 cm", "cm", 12],
    ["120mm", "cm", 12],
    ["0,12 m", "cm", 12],
    ["0.12 m", "m", 0.12],
    ["−6 cm", "cm", -6],
    ["1e-3 m", "mm", 1],
    ["30 km/h", "km/h", 30],
    ["8.3 m/s", "km/h", 29.88],
    ["30 kmh", "m/s", 8.33333333333],
    ["1,2 kN", "N", 1200],
    ["22\u202f245 N/m", "N/m", 22245],
    ["22.2 N/mm", "N/m", 22200],
    ["1500 Ns/m", "N·s/m", 1500],
    ["1.5 MPa", "Pa", 1.5e6],
    ["15 bar", "MPa", 1.5],
    ["2°", "rad", 0.0349065850399],
    ["2 deg/s²", "rad/s^2", 0.0349065850399],
    ["0.3 g", "m/s^2", 2.941995],
    ["3 m/s2", "m/s^2", 3],
    ["64 cm³", "m^3", 64e-6],
    ["60 %", "1", 0.6],
    ["1.2 kg·m²", "kg·m^2", 1.2],
    ["5 m/s^1.75", "m/s^1.75", 5],
  ])("%s where %s is asked for", (text, unit, expected) => {
    expect(value(text, unit)).toBe(expected);
  });

  it.each([
    ["12 kg", "cm", "Takes cm (also without a unit), m, mm, km, in, ft or µm"],
    ["3 furlongs", "km/h", "Takes km/h (also without a unit), m/s, mph, ft/s, kn, cm/s or mm/s"],
    ["2 m", "1", "Takes a number without a unit, or %"],
    ["2 m", "1/N^2", "Takes 1/N² (also without a unit)"],
    ["5,000", "N", "Enter a number, e.g. 12 N; no commas for thousands"],
    ["1.2.3 m", "m", "Enter a number, e.g. 12 m; no commas for thousands"],
    ["high", "1", "Enter a number, e.g. 0.12; no commas for thousands"],
  ])("%s where %s is asked for is refused: %s", (text, unit, message) => {
    expect(value(text, unit)).toBe(message);
  });
});

it("a unit is shown in another of its kind", () => {
  expect([
    shownIn("m", "cm").scale,
    shownIn("m", "mm").scale,
    shownIn("km/h", "km/h").scale,
    shownIn("1/N^2", "1/N^2").scale,
  ]).toEqual([100, 1000, 1, 1]);
});

it("the unit behind a shown one is found by its scale", () => {
  expect(
    [
      { unit: "kN", scale: 1e-3 },
      { unit: "mm", scale: 1000 },
      { unit: "m/s²", scale: 1 },
      { unit: "1", scale: 1 },
    ].map(unitBehind),
  ).toEqual(["N", "m", "m/s^2", "1"]);
});
