/** A table of measurements as somebody else wrote it: how it is laid out, what its columns are or may be, and the same with titles and units. */

import { isSameUnit, unitsLike } from "../../units/quantity";
import type { Catalogue } from "../../api/types";

/** What a column may be. */
export interface Role {
  readonly id: string;
  readonly label: string;
  /** Titles that the server knows it by too, in small letters, with blanks between words. */
  readonly titles: readonly string[];
  /** Others. */
  readonly moreTitles?: readonly string[];
  /** The likeliest first. */
  readonly units: readonly string[];
}

/** What a table may be of. */
export interface TableKind {
  readonly id: string;
  readonly label: string;
  readonly roles: readonly Role[];
  /** The roles of columns without titles. */
  readonly places: (columns: number) => readonly string[];
  /** What is missing or twice among the roles; `null` where nothing is. */
  readonly faultOf: (uses: readonly Use[]) => string | null;
}

export interface Layout {
  /** A blank stands for any number of them. */
  readonly separator: "," | ";" | "\t" | " ";
  readonly decimalComma: boolean;
  readonly hasHeader: boolean;
}

/** What one column is; the role is empty where it is left out. */
export interface Use {
  readonly role: string;
  /** Empty where none is chosen: the title says none, or one that is not understood. */
  readonly unit: string;
}

/** How a text looks with a layout. */
export interface Table {
  /** Of the columns; their numbers where there is no header. */
  readonly titles: readonly string[];
  readonly rows: readonly (readonly string[])[];
}

const SEPARATORS = ["\t", ";", ",", " "] as const;
/** Lines that a layout is guessed from. */
const SEEN = 40;

const isContent = (line: string) => line.trim() !== "" && !line.trimStart().startsWith("#");
const cellsOf = (line: string, separator: Layout["separator"]) =>
  (separator === " " ? line.trim().split(/\s+/) : line.split(separator)).map((cell) =>
    cell.trim().replace(/^"(.*)"$/, "$1"),
  );

/** The number in a cell; NaN where there is none. */
function numberIn(cell: string, decimalComma: boolean): number {
  const text = decimalComma ? cell.replace(",", ".") : cell;
  return text === "" ? NaN : Number(text);
}

const isNumber = (cell: string) => Number.isFinite(numberIn(cell, true));

/** The likeliest layout: the separator that gives the lines one number of cells, most of them numbers. */
export function guessLayout(text: string): Layout {
  const lines = text.slice(0, 100_000).split(/\r?\n/).filter(isContent).slice(0, SEEN);
  const body = lines.length > 1 ? lines.slice(1) : lines;
  const fit = (separator: Layout["separator"]) => {
    const cells = body.map((line) => cellsOf(line, separator));
    const columns = cells[0]?.length ?? 0;
    const shares = cells.map((row) => (row.length === columns ? row.filter(isNumber).length / columns : 0));
    return columns > 1 ? shares.reduce((sum, share) => sum + share, 0) : 0;
  };
  const best = SEPARATORS.reduce((one, other) => (fit(other) > fit(one) ? other : one));
  const separator = fit(best) > 0 ? best : ",";
  const decimalComma = separator !== "," && body.some((line) => /\d,\d|^,\d/.test(line));
  const [first = [], second = []] = [lines[0] ?? "", body[0] ?? ""].map((line) => cellsOf(line, separator));
  const hasHeader = first.some((cell, index) => !isNumber(cell) && isNumber(second[index] ?? ""));
  return { separator, decimalComma, hasHeader };
}

/** The table's titles and its first rows, or all of them. */
export function tableOf(text: string, { separator, hasHeader }: Layout, most = Infinity): Table {
  const lines = (most === Infinity ? text : text.slice(0, 2000 + 200 * most)).split(/\r?\n/).filter(isContent);
  const rows = lines.slice(hasHeader ? 1 : 0, most).map((line) => cellsOf(line, separator));
  const head = hasHeader
    ? cellsOf(lines[0] ?? "", separator)
    : (rows[0] ?? []).map((_, index) => `Column ${index + 1}`);
  return { titles: head, rows };
}

const IN_BRACKETS = /^(.*?)\s*[[(]\s*([^\])]*?)\s*[\])]?$/;
const AT_THE_END = /^(.+)[\s_-]([^\s_-]+)$/;

/** A title's name, and the unit that it says, as it is written: in brackets, or at its end where that is one of `units`. */
function partsOf(title: string, units: readonly string[]): { readonly name: string; readonly written: string } {
  const [, inside, written] = IN_BRACKETS.exec(title) ?? [];
  if (inside !== undefined && written !== undefined) return { name: inside, written };
  const [, before, last] = AT_THE_END.exec(title) ?? [];
  const isUnit = last !== undefined && units.some((unit) => isSameUnit(unit, last));
  return before !== undefined && isUnit ? { name: before, written: last } : { name: title, written: "" };
}

/** The unit that a title says, as it is written; empty where it says none. */
export const writtenUnit = (title: string, { units }: Pick<Role, "units">): string => partsOf(title, units).written;

/** The unit of a column in that role: the one its title says, the likeliest where it says none, none where it is not understood. */
export function unitOf(title: string, role: Pick<Role, "units">): string {
  const written = writtenUnit(title, role);
  if (written === "") return role.units[0] ?? "";
  return role.units.find((each) => isSameUnit(each, written)) ?? "";
}

/** What each column is by its title, or, where none is known, by its place. */
export function guessUses({ titles }: Table, { roles, places }: Pick<TableKind, "roles" | "places">): readonly Use[] {
  const found = titles.map((title) =>
    roles.find(({ titles, moreTitles = [], units }) => [...titles, ...moreTitles].includes(plainName(title, units))),
  );
  const ids = places(titles.length);
  const isAnyKnown = found.some((role) => role !== undefined);
  return titles.map((title, index): Use => {
    const role = isAnyKnown ? found[index] : roles.find(({ id }) => id === ids[index]);
    return role ? { role: role.id, unit: unitOf(title, role) } : { role: "", unit: "" };
  });
}

const plainName = (title: string, units: readonly string[]) =>
  partsOf(title, units)
    .name.trim()
    .toLowerCase()
    .replace(/[\s_-]+/g, " ");

/** What is said of a unit that is not understood; `null` where each column that is used has one. */
export function unitFault(titles: readonly string[], uses: readonly Use[], roles: readonly Role[]): string | null {
  const index = uses.findIndex(({ role, unit }) => role !== "" && unit === "");
  const role = roles.find(({ id }) => id === uses[index]?.role);
  const title = titles[index];
  if (role === undefined || title === undefined) return null;
  return `“${writtenUnit(title, role)}”, the unit of “${title}”, is not understood: choose the unit`;
}

/** Whether each column says itself what it is, and in which unit, so that the server knows it too. */
const areClear = (titles: readonly string[], uses: readonly Use[], roles: readonly Role[]): boolean =>
  uses.length > 0 &&
  uses.every(({ role: id, unit }, index) => {
    const role = roles.find((each) => each.id === id);
    const [, name = "", written] = IN_BRACKETS.exec(titles[index] ?? "") ?? [];
    return role?.titles.includes(plainName(name, [])) === true && unit !== "" && written === unit;
  });

/** The numbers of each column that is used, by its role. */
export function columnsOf(table: Table, uses: readonly Use[], decimalComma: boolean): ReadonlyMap<string, number[]> {
  const used = uses.flatMap(({ role }, index) => (role === "" ? [] : [[role, index] as const]));
  return new Map(
    used.map(([role, index]) => [role, table.rows.map((row) => numberIn(row[index] ?? "", decimalComma))]),
  );
}

/** The used columns with titles and units, commas in between. Empty lines and comments stay, so that lines keep their numbers. */
export function rewritten(text: string, layout: Layout, uses: readonly Use[]): string {
  const used = uses.flatMap((use, index) => (use.role === "" ? [] : [{ ...use, index }]));
  const title = used.map(({ role, unit }) => `${role} [${unit}]`).join(",");
  let isTitled = false;
  const lines = text.split(/\r?\n/).map((line) => {
    if (!isContent(line)) return line;
    if (!isTitled && layout.hasHeader) {
      isTitled = true;
      return title;
    }
    const cells = cellsOf(line, layout.separator);
    return used
      .map(({ index }) => (layout.decimalComma ? (cells[index] ?? "").replace(",", ".") : (cells[index] ?? "")))
      .join(",");
  });
  return layout.hasHeader ? lines.join("\n") : [title, ...lines].join("\n");
}

const HEIGHTS = ["mm", "m", "cm", "um", "µm", "in", "ft"];

export const ROAD: TableKind = {
  id: "road",
  label: "a measured road",
  roles: [
    {
      id: "distance",
      label: "Distance",
      titles: ["distance", "position", "station", "x", "s"],
      units: ["m", "km", "cm", "mm", "ft", "in"],
    },
    { id: "height", label: "Height", titles: ["height", "elevation", "z", "profile"], units: HEIGHTS },
    {
      id: "left",
      label: "Left height",
      titles: ["left", "left height", "z left"],
      moreTitles: ["left elevation", "left profile"],
      units: HEIGHTS,
    },
    {
      id: "right",
      label: "Right height",
      titles: ["right", "right height", "z right"],
      moreTitles: ["right elevation", "right profile"],
      units: HEIGHTS,
    },
  ],
  places: (columns) => (columns === 2 ? ["distance", "height"] : ["distance", "left", "right"]),
  faultOf: roadFault,
};

/** How many metres the units are. */
export const METRES: Readonly<Record<string, number>> = { ...unitsLike("m"), um: 1e-6, µm: 1e-6 };

function roadFault(uses: readonly Use[]): string | null {
  const roles = uses.map(({ role }) => role).filter((role) => role !== "");
  const wanted = roles.includes("height") ? ["distance", "height"] : ["distance", "left", "right"];
  const isWhole = roles.length === wanted.length && wanted.every((role) => roles.includes(role));
  return isWhole ? null : "One column is the distance, and one the height, or two are the left and the right height";
}

interface Signals extends Pick<Catalogue, "metric_signals"> {
  readonly signals: readonly Pick<Catalogue["signals"][number], "key" | "label" | "unit">[];
}

/** Other titles that the server knows. */
const SIGNAL_TITLES: Readonly<Record<string, readonly string[]>> = {
  time: ["t"],
  position: ["position", "distance"],
  speed: ["v", "velocity", "vehicle speed"],
};

/** Its columns are signals of the catalogue. */
export const driveKind = ({ signals, metric_signals }: Signals): TableKind => ({
  id: "drive",
  label: "a recorded drive",
  roles: signals.map(({ key, label, unit }) => ({
    id: key,
    label,
    titles: [key.replaceAll("_", " "), label.toLowerCase(), ...(SIGNAL_TITLES[key] ?? [])],
    units: [unit, ...Object.keys(unitsLike(unit)).filter((other) => other !== unit)],
  })),
  places: () => ["time"],
  faultOf: (uses) => {
    const roles = uses.map(({ role }) => role).filter((role) => role !== "");
    const twice = signals.find(({ key }) => roles.filter((role) => role === key).length > 1);
    if (twice) return `Two columns are ${twice.label.toLowerCase()}: leave one out`;
    if (!roles.includes("time") && !roles.includes("position")) return "One column is the time or the distance";
    if (!roles.some((role) => metric_signals.includes(role)))
      return "One column at least is a signal to compare, such as the body acceleration";
    return null;
  },
});

/** An OpenCRG file: its values begin behind a line of dollars. */
export const isOpenCrg = (text: string): boolean => /^\$\$\$\$/m.test(text);

/** What the table in a file is likely of; `null` where there is none, or where each column of a road says what it is. */
export function likelyKind(name: string, text: string): "road" | "drive" | null {
  if (/\.json$/i.test(name) || /^\s*[[{]/.test(text) || isOpenCrg(text) || /^\ufeff?# Ridelab road /.test(text))
    return null;
  const layout = guessLayout(text);
  const table = tableOf(text, layout, 40);
  if (table.titles.length < 2 || !/\d/.test(table.rows[0]?.join("") ?? "")) return null;
  const uses = guessUses(table, layout.hasHeader ? { ...ROAD, places: () => [] } : ROAD);
  if (areClear(table.titles, uses, ROAD.roles) && roadFault(uses) === null && !text.includes('"')) return null;
  const hasHeights = uses.some(({ role }) => role !== "" && role !== "distance");
  const areLengths = table.titles.every((title) => /[[(]\s*(k|c|m|u|µ)?m\s*[\])]$/.test(title.trim()));
  const isRoad = !layout.hasHeader || hasHeights || (areLengths && !/deflection|travel/i.test(table.titles.join()));
  return isRoad ? "road" : "drive";
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
