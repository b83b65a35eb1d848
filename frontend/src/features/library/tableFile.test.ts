import { expect, test } from "vitest";
import { guessUses, driveKind, isOpenCrg, likelyKind, ROAD, TEMPLATE } from "./columns";

test.each([
  ["x.csv", "0;1,5\n0,1;1,25\n", "road"],
  ["x.txt", "0.0 1.5 1.6\n0.1 1.25 1.3\n", "road"],
  ["x.csv", "Weg [m];links [mm];rechts [mm]\n0;1;2\n1;2;3\n", "road"],
  ["x.csv", "distance,height\n0,1\n1,2\n", "road"],
  ["x.csv", "distance [m],height [mm],quality [m]\n0,1,1\n1,2,1\n", "road"],
  ["x.csv", "distance [m],height [mm]\n0,1\n1,x\n", null],
  ["x.csv", "distance_m,elevation_mm\n0,1\n1,2\n", "road"],
  ["x.csv", "distance [inch],height [mm]\n0,1\n1,2\n", "road"],
  ["x.csv", '"distance [m]","height [mm]"\n"0","1"\n"1","2"\n', "road"],
  ["x.csv", "Distance (ft),Left Elevation (in),Right Elevation (in)\n0,1,1\n1,2,2\n", "road"],
  ["template.csv", TEMPLATE, null],
  ["x.csv", "# Ridelab road AAAAAAAAAAAAAAAAAAAAAA: a height every 10 mm\nheight [m]\n0\n1\n", null],
  ["x.csv", "time [s],speed [km/h]\n0,1\n1,2\n", "drive"],
  ["x.csv", "distance [m],front_deflection [mm]\n0,1\n1,2\n", "drive"],
  ["x.json", "[0, 1]", null],
  ["x.crg", "$CT\n$\n$$$$$$\n 0.1 0.2\n 0.3 0.4\n", null],
  ["x.txt", "Dear all, hello\n", null],
])("%s is asked about where its columns do not say what they are: %j", (name, text, likely) => {
  expect(likelyKind(name, text)).toBe(likely);
});

test("a recorded drive has a time or a distance, and signals of the catalogue in units of its own", () => {
  const kind = driveKind({
    signals: [
      { key: "time", label: "Time", unit: "s" },
      { key: "position", label: "Distance", unit: "m" },
      { key: "body_acceleration", label: "Body acceleration", unit: "m/s^2" },
    ],
    metric_signals: ["body_acceleration"],
  });
  const uses = (titles: string) => guessUses({ titles: titles.split(","), rows: [] }, kind);
  const [time, acceleration] = uses("T [ms],Body-Acceleration (M/S²),driver");
  expect(time).toEqual({ role: "time", unit: "ms" });
  expect(acceleration).toEqual({ role: "body_acceleration", unit: "m/s^2" });
  expect(uses("body_acceleration [furlong]")[0]).toEqual({ role: "body_acceleration", unit: "" });
  for (const [titles, said] of [
    ["time [s],body_acceleration [g],driver", null],
    ["time,t,body_acceleration", /^Two columns are time/],
    ["body_acceleration", /the time or the distance$/],
    ["time,distance", /a signal to compare/],
  ] as const)
    expect(kind.faultOf(uses(titles)) ?? "").toMatch(said ?? /^$/);
});

test("a road has a distance, and one height or two", () => {
  const of = (...roles: string[]) => ROAD.faultOf(roles.map((role) => ({ role, unit: "m" })));
  expect(of("distance", "", "height")).toBeNull();
  expect(of("right", "left", "distance")).toBeNull();
  for (const wrong of [["distance"], ["distance", "left"], ["distance", "height", "left"], ["height", "left", "right"]])
    expect(of(...wrong)).toMatch(/^One column is the distance/);
  expect(isOpenCrg("$CT\n$\n$$$$$$\n")).toBe(true);
});
