/** Numbers as people write them, with or without a unit: the client's command line reads the same table. */

import { parseInput, prettyUnit } from "./format";
import table from "./units.gen.json";

/** The unit a value is shown in, and the factor to it. */
export interface ShownUnit {
  readonly unit: string;
  readonly scale: number;
}

export type Quantity = { readonly ok: true; readonly value: number } | { readonly ok: false; readonly message: string };

const RAISED: Readonly<Record<string, string>> = { "⁰": "0", "¹": "1", "²": "2", "³": "3", "⁴": "4", "⁻": "-", μ: "µ" };
const NUMBER = /^[+-]?(?:[\d.,\u202f\u00a0]|\s(?=\d))*(?:e[+-]?\d+)?/i;

/** `kg·m²`, `kg*m^2` and `KG m2` are one. */
const keyOf = (unit: string) =>
  Array.from(unit, (character) => RAISED[character] ?? character)
    .join("")
    .replace(/[·⋅*^\s]/g, "")
    .toLowerCase();

const ALIASES = new Map(Object.entries(table.aliases).map(([alias, unit]) => [keyOf(alias), keyOf(unit)]));

const plainKey = (unit: string) => ALIASES.get(keyOf(unit)) ?? keyOf(unit);

/** Whether two spellings are of one unit. */
export const isSameUnit = (one: string, other: string): boolean => plainKey(one) === plainKey(other);

/** Every unit of what this one measures; this one alone where the table does not have it. */
export function unitsLike(unit: string): Readonly<Record<string, number>> {
  const all: readonly Readonly<Record<string, number>>[] = Object.values(table.units);
  return all.find((units) => unit in units) ?? { [unit]: 1 };
}

/** What somebody may call a unit: every one that measures the same, in each spelling, and what they measure. */
export function unitWords(unit: string): string {
  const [quantity = ""] = Object.entries(table.units).find(([, units]) => unit in units) ?? [];
  const units = Object.keys(unitsLike(unit));
  const spelt = Object.entries(table.aliases).flatMap(([alias, of]) => (units.includes(of) ? [alias] : []));
  return [quantity, ...units.map(prettyUnit), ...spelt].join(" ");
}

const rounded = (value: number) => Number(value.toPrecision(12));

/** How a value in `unit` is shown in `other`, which measures the same. */
export function shownIn(unit: string, other: string): ShownUnit {
  const units = unitsLike(unit);
  const [own = 1, shown = own] = [units[unit], units[other]];
  return { unit: other, scale: rounded(own / shown) };
}

/** The unit whose values are shown so: `N` behind `kN` with 0.001. */
export function unitBehind({ unit, scale }: ShownUnit): string {
  const plain = unit.replace("²", "^2");
  const units = unitsLike(plain);
  const factor = (units[plain] ?? 1) * scale;
  return scale === 1
    ? plain
    : (Object.keys(units).find((name) => rounded(units[name] ?? 0) === rounded(factor)) ?? plain);
}

/** What was typed, in `unit`, which a number alone is in. */
export function parseQuantity(text: string, unit: string): Quantity {
  const compact = text.trim().replace("−", "-");
  const [digits = ""] = NUMBER.exec(compact) ?? [];
  const value = parseInput(digits);
  if (value === null)
    return {
      ok: false,
      message: `Enter a number, e.g. ${unit === "1" ? "0.12" : `12 ${prettyUnit(unit)}`}; no commas for thousands`,
    };
  const written = compact.slice(digits.length);
  if (keyOf(written) === "") return { ok: true, value };
  const own = unit.replace("²", "^2");
  const units = unitsLike(own);
  const match = Object.entries(units).find(([name]) => isSameUnit(name, written));
  if (!match) return { ok: false, message: `Takes ${listed(units, own)}` };
  return { ok: true, value: rounded((value * match[1]) / (units[own] ?? 1)) };
}

/** `cm (without a unit), m, mm, km, in, ft or µm`. */
function listed(units: Readonly<Record<string, number>>, own: string): string {
  if (own === "1") return "a number without a unit, or %";
  const others = Object.keys(units)
    .filter((name) => name !== own)
    .map(prettyUnit);
  const last = others.pop();
  const all = [`${prettyUnit(own)} (also without a unit)`, ...others].join(", ");
  return last === undefined ? all : `${all} or ${last}`;
}
