import { expect, test } from "vitest";
import { hasUnclearColumns, isOpenCrg, roadFault, TEMPLATE } from "./roadFile";

test.each([
  ["x.csv", "0;1,5\n0,1;1,25\n", true],
  ["x.txt", "0.0 1.5 1.6\n0.1 1.25 1.3\n", true],
  ["x.csv", "Weg [m];links [mm];rechts [mm]\n0;1;2\n1;2;3\n", true],
  ["x.csv", "distance,height\n0,1\n1,2\n", true],
  ["x.csv", "distance [m],height [mm],quality [m]\n0,1,1\n1,2,1\n", true],
  ["x.csv", "distance [m],height [mm]\n0,1\n1,x\n", false],
  ["template.csv", TEMPLATE, false],
  ["x.csv", "# Ridelab road AAAAAAAAAAAAAAAAAAAAAA: a height every 10 mm\nheight [m]\n0\n1\n", false],
  ["x.csv", "time [s],speed [km/h]\n0,1\n1,2\n", false],
  ["x.csv", "distance [m],front_deflection [mm]\n0,1\n1,2\n", false],
  ["x.json", "[0, 1]", false],
  ["x.crg", "$CT\n$\n$$$$$$\n 0.1 0.2\n 0.3 0.4\n", false],
  ["x.txt", "Dear all, hello\n", false],
])("%s is asked about where its columns do not say what they are: %j", (name, text, asked) => {
  expect(hasUnclearColumns(name, text)).toBe(asked);
});

test("a road has a distance, and one height or two", () => {
  const of = (...roles: string[]) => roadFault(roles.map((role) => ({ role, unit: "m" })));
  expect(of("distance", "", "height")).toBeNull();
  expect(of("right", "left", "distance")).toBeNull();
  for (const wrong of [["distance"], ["distance", "left"], ["distance", "height", "left"], ["height", "left", "right"]])
    expect(of(...wrong)).toMatch(/^One column is the distance/);
  expect(isOpenCrg("$CT\n$\n$$$$$$\n")).toBe(true);
});
