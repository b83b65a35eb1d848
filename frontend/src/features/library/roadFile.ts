/** A measured road's file in a form of its own: what its columns may be, and when that has to be asked. */

import { areClear, guessLayout, guessUses, tableOf, type Role, type Use } from "../mapping/columns";

const HEIGHTS = ["mm", "m", "cm", "um", "µm", "in", "ft"];

/** By the titles that the server knows. */
export const ROAD_ROLES: readonly Role[] = [
  {
    id: "distance",
    label: "Distance",
    titles: ["distance", "position", "station", "x", "s"],
    units: ["m", "km", "cm", "mm", "ft", "in"],
  },
  { id: "height", label: "Height", titles: ["height", "elevation", "z", "profile"], units: HEIGHTS },
  { id: "left", label: "Left height", titles: ["left", "left_height", "left height", "z_left"], units: HEIGHTS },
  { id: "right", label: "Right height", titles: ["right", "right_height", "right height", "z_right"], units: HEIGHTS },
];

/** Distance first, then one height or left and right. */
export const roadPlaces = (columns: number): readonly string[] =>
  columns === 2 ? ["distance", "height"] : ["distance", "left", "right"];

/** How many metres the units are. */
export const METRES: Readonly<Record<string, number>> = {
  m: 1,
  km: 1000,
  cm: 0.01,
  mm: 0.001,
  um: 1e-6,
  µm: 1e-6,
  ft: 0.3048,
  in: 0.0254,
};

export function roadFault(uses: readonly Use[]): string | null {
  const roles = uses.map(({ role }) => role).filter((role) => role !== "");
  const wanted = roles.includes("height") ? ["distance", "height"] : ["distance", "left", "right"];
  const isWhole = roles.length === wanted.length && wanted.every((role) => roles.includes(role));
  return isWhole ? null : "One column is the distance, and one the height, or two are the left and the right height";
}

/** An OpenCRG file: its values begin behind a line of dollars. */
export const isOpenCrg = (text: string): boolean => /^\$\$\$\$/m.test(text);

/** Whether a text is a table of heights whose columns do not say themselves what they are; a recorded drive has its own dialog. */
export function hasUnclearColumns(name: string, text: string): boolean {
  if (/\.json$/i.test(name) || /^\s*[[{]/.test(text) || isOpenCrg(text) || /^\ufeff?# Ridelab road /.test(text))
    return false;
  const layout = guessLayout(text);
  const table = tableOf(text, layout, 40);
  const isTable = table.titles.length > 1 && /\d/.test(table.rows[0]?.join("") ?? "");
  const uses = guessUses(table, ROAD_ROLES, layout.hasHeader ? () => [] : roadPlaces);
  const hasHeights = uses.some(({ role }) => role !== "" && role !== "distance");
  const areLengths = table.titles.every((title) => /[[(]\s*(k|c|m|u|µ)?m\s*[\])]$/.test(title.trim()));
  const isRoad = !layout.hasHeader || hasHeights || (areLengths && !/deflection|travel/i.test(table.titles.join()));
  return isTable && isRoad && !(areClear(uses) && roadFault(uses) === null);
}

/** A file to fill in. */
export const TEMPLATE = `# A measured road: one line for each place, in order, at most 5 m apart; the road from 5 m to 3 km long.
# Units are m, km, cm, mm, um, ft or in. One height in place of two: distance [m],height [mm]
distance [m],left [mm],right [mm]
${Array.from({ length: 61 }, (_, index) => {
  const hump = index > 20 && index < 40 ? 20 * (1 - Math.cos((Math.PI * (index - 20)) / 10)) : 0;
  return `${(index / 5).toFixed(1)},${hump.toFixed(1)},${(hump + (index % 3)).toFixed(1)}`;
}).join("\n")}
`;
