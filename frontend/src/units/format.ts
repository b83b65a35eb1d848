/** Numbers and units as a person reads them. */

export const NO_VALUE = "–";

const SUPERSCRIPT: Readonly<Record<string, string>> = {
  "0": "⁰",
  "1": "¹",
  "2": "²",
  "3": "³",
  "4": "⁴",
  "5": "⁵",
  "6": "⁶",
  "7": "⁷",
  "8": "⁸",
  "9": "⁹",
  "-": "⁻",
  "−": "⁻",
  ".": "·",
};

function raised(text: string): string {
  return Array.from(text, (character) => SUPERSCRIPT[character] ?? character).join("");
}

/** `kg·m^2` → `kg·m²`; the unit of a plain number, `1`, is nothing. */
export function prettyUnit(unit: string): string {
  return unit === "1" ? "" : unit.replace(/\^(-?[\d.]+)/g, (_, power: string) => raised(power));
}

/** `Height [m]`. */
export const titleWithUnit = (title: string, unit: string): string =>
  prettyUnit(unit) === "" ? title : `${title} [${prettyUnit(unit)}]`;

/** A real minus sign, which is as wide as a plus. */
function withMinus(text: string): string {
  return text.replace(/^-/, "−");
}

/** `digits` significant digits, without an exponent while that stays readable. */
export function formatNumber(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return NO_VALUE;
  if (value === 0) return "0";
  const size = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))));
  if (size < -4 || size > 7) {
    const mantissa = Number((value / 10 ** size).toPrecision(digits));
    return withMinus(`${mantissa}×10${raised(String(size))}`);
  }
  const text = value.toFixed(Math.max(0, digits - 1 - size));
  return withMinus(size >= 4 ? grouped(text) : text);
}

/** Far below what any unit a result is shown in resolves: what rounding leaves of a zero. */
const NOTHING = 1e-9;

export const isNothing = (value: number): boolean => Math.abs(value) < NOTHING;

/** A result in the unit it is shown in: rounding errors are zero. */
export function formatResult(value: number, digits = 3): string {
  return isNothing(value) ? "0" : formatNumber(value, digits);
}

/** Half an interval's width, to stand behind `result`: as many decimals as that has, more only where it would be 0. */
export function formatHalf(half: number, result: string): string {
  const text = half.toFixed(/\.(\d+)$/.exec(result)?.[1]?.length ?? 0);
  return Number(text) === 0 || result.includes("×") ? formatNumber(half, 1) : text;
}

/** A fixed number of decimals; what rounds to zero has no sign. */
export function formatFixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : withMinus(text);
}

function grouped(text: string): string {
  return text.replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
}

/** A field's value as it would be typed: every digit it has, none it has not. */
export function formatInput(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const plain = Number(value.toPrecision(10));
  return size < 1e-4 || size >= 1e9 ? plain.toExponential().replace("e+", "e") : String(plain);
}

/**
 * A number from what somebody typed, `null` where it is none. A comma may stand for the decimal point, except
 * where it could as well separate thousands (`5,000`).
 */
export function parseInput(text: string): number | null {
  const compact = text
    .trim()
    .replace("−", "-")
    .replace(/[\s\u202f\u00a0]/g, "");
  const plain = /^[+-]?[1-9]\d*,\d{3}$/.test(compact) ? "" : compact.replace(/^([^.,]*),([^.,]*)$/, "$1.$2");
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return null;
  const value = Number(plain);
  return Number.isFinite(value) ? value : null;
}

/** Every digit a value has, with its unit: for defaults and limits. */
export function formatExact(value: number, unit: string): string {
  const text = withMinus(formatInput(value));
  const number = /^−?\d{5,}$/.test(text) ? grouped(text) : text;
  const shown = prettyUnit(unit);
  return shown === "" ? number : `${number}\u00a0${shown}`;
}

/** A whole number: `1200`, `12 345`. */
export function formatWhole(number: number): string {
  const text = String(number);
  return text.length > 4 ? grouped(text) : text;
}

/** `1 run`, `12 345 runs`. */
export function count(number: number, one: string, several = `${one}s`): string {
  return `${formatWhole(number)} ${number === 1 ? one : several}`;
}

export function formatWithUnit(value: number, unit: string, digits = 3): string {
  const shown = prettyUnit(unit);
  return shown === "" ? formatNumber(value, digits) : `${formatNumber(value, digits)}\u00a0${shown}`;
}

/** Dates as a person reads them, without a doubt which number is the month. */
const DATE = { day: "numeric", month: "short", year: "numeric" } as const;
const DAY = new Intl.DateTimeFormat("en-GB", DATE);
const MINUTE = new Intl.DateTimeFormat("en-GB", { ...DATE, hour: "2-digit", minute: "2-digit" });

export const formatDay = (iso: string) => DAY.format(new Date(iso));

export const formatMinute = (iso: string) => MINUTE.format(new Date(iso));

/** `a few seconds`, `40 s`, `3 min`, `2.5 h`: as exact as an estimate deserves. */
export function formatDuration(seconds: number): string {
  if (seconds < 2) return "a second or two";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  const minutes = seconds / 60;
  if (minutes < 90) return `${Math.round(minutes)} min`;
  return `${(minutes / 60).toFixed(1)} h`;
}
