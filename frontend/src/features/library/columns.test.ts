import { expect, test } from "vitest";
import {
  columnsOf,
  guessLayout,
  guessUses,
  likelyKind,
  rewritten,
  ROAD,
  tableOf,
  unitFault,
  type Role,
  type TableKind,
} from "./columns";

const ROLES: readonly Role[] = [
  { id: "distance", label: "Distance", titles: ["distance", "x"], units: ["m", "km"] },
  { id: "left", label: "Left", titles: ["left"], units: ["mm", "m"] },
  { id: "right", label: "Right", titles: ["right"], units: ["mm", "m"] },
];
const PLACES = (columns: number) => ["distance", "left", "right"].slice(0, columns);

test.each([
  ["distance [m],left [mm]\n0,1\n1,2\n", { separator: ",", decimalComma: false, hasHeader: true }],
  ["0;1,5;2\n0,1;1,25;2\n", { separator: ";", decimalComma: true, hasHeader: false }],
  ["# a comment\n\nx\tleft\n0\t1.5\n", { separator: "\t", decimalComma: false, hasHeader: true }],
  ["  0.0   1.5\n  0.1  -2e-3\n", { separator: " ", decimalComma: false, hasHeader: false }],
  ["0,0;ok;1,5;1\n0,1;ok;1,25;2\n", { separator: ";", decimalComma: true, hasHeader: false }],
  ["Weg [m];links\n0,0;3\n0,1;4\n", { separator: ";", decimalComma: true, hasHeader: true }],
] as const)("a layout is seen from the lines: %s", (text, layout) => {
  expect(guessLayout(text)).toEqual(layout);
});

const OF_ROLES: Pick<TableKind, "roles" | "places"> = { roles: ROLES, places: PLACES };
const usesOf = (text: string, kind = OF_ROLES) => guessUses(tableOf(text, guessLayout(text)), kind);

test("columns are known by their titles, or else by their places", () => {
  expect(usesOf("X (m), Left [mm]\n0,1\n1,2\n")).toEqual([
    { role: "distance", unit: "m" },
    { role: "left", unit: "mm" },
  ]);
  expect(usesOf("0;1;2\n1;2;3\n")).toEqual([
    { role: "distance", unit: "m" },
    { role: "left", unit: "mm" },
    { role: "right", unit: "mm" },
  ]);
  expect(usesOf("x [m],left [mm],note\n0,1,2\n1,2,3\n")[2]).toEqual({ role: "", unit: "" });
});

test.each([
  ["distance (feet)", "ft"],
  ["distance [inch]", "in"],
  ["distance_km", "km"],
  ["distance m", "m"],
  ["distance", "m"],
  ["distance []", "m"],
])("a unit is what the title says, and the likeliest only where it says none: %s", (title, unit) => {
  expect(usesOf(`${title},height [mm]\n0,1\n1,2\n`, ROAD)[0]).toEqual({ role: "distance", unit });
});

test.each([
  ["distance (furlong),height (inches)", "furlong", "distance (furlong)"],
  ["distance [m],left [mm],right [°]", "°", "right [°]"],
])("a unit that is not understood is named, and none stands in for it: %s", (titles, unit, title) => {
  const text = `${titles}\n0,1,2\n1,2,3\n`;
  const uses = usesOf(text, ROAD);
  const fault = unitFault(titles.split(","), uses, ROAD.roles);
  expect(fault).toBe(`“${unit}”, the unit of “${title}”, is not understood: choose the unit`);
  expect(uses.filter((use) => use.unit === "")).toHaveLength(1);
  const chosen = uses.map((use) => ({ ...use, unit: use.unit || "m" }));
  expect(unitFault(titles.split(","), chosen, ROAD.roles)).toBeNull();
  expect(likelyKind("x.csv", text)).toBe("road");
});

test("a mapped table has titles, units, points and commas; its lines keep their numbers", () => {
  const text = "# from the van\n\n0;1,5;9\r\n0,1;1,25;x\n";
  const uses = [
    { role: "distance", unit: "m" },
    { role: "left", unit: "mm" },
    { role: "", unit: "" },
  ];
  const layout = guessLayout("0;1,5;9\n0,1;1,25;8");
  expect(rewritten(text, layout, uses)).toBe("distance [m],left [mm]\n# from the van\n\n0,1.5\n0.1,1.25\n");
  const titled = rewritten("a;b;c\n0;1,5;9\n", { ...layout, hasHeader: true }, uses);
  expect(titled).toBe("distance [m],left [mm]\n0,1.5\n");
  const columns = columnsOf(tableOf(text, layout), uses, true);
  expect([...columns]).toEqual([
    ["distance", [0, 0.1]],
    ["left", [1.5, 1.25]],
  ]);
});
