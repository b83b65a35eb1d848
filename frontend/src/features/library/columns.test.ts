import { expect, test } from "vitest";
import { areClear, columnsOf, guessLayout, guessUses, rewritten, tableOf, type Role } from "./columns";

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

test("columns are known by their titles, or else by their places", () => {
  const of = (text: string) => guessUses(tableOf(text, guessLayout(text)), { roles: ROLES, places: PLACES });
  const clear = of("X (m), Left [mm]\n0,1\n1,2\n");
  expect(clear).toEqual([
    { role: "distance", unit: "m" },
    { role: "left", unit: "mm" },
  ]);
  expect(areClear(clear)).toBe(true);
  const untitled = of("0;1;2\n1;2;3\n");
  expect(untitled.map(({ role }) => role)).toEqual(["distance", "left", "right"]);
  expect(areClear(untitled)).toBe(false);
  expect(areClear(of("x [m],left [furlong]\n0,1\n1,2\n"))).toBe(false);
  expect(areClear(of("x [m],left [mm],note\n0,1,2\n1,2,3\n"))).toBe(false);
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
