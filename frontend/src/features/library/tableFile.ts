/** Tables of measured roads and recorded drives: what their columns may be, and when that has to be asked. */

import type { Catalogue } from "../../api/types";
import { unitsLike } from "../../units/quantity";
import { areClear, guessLayout, guessUses, tableOf, type TableKind, type Use } from "./columns";

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
    { id: "left", label: "Left height", titles: ["left", "left height", "z left"], units: HEIGHTS },
    { id: "right", label: "Right height", titles: ["right", "right height", "z right"], units: HEIGHTS },
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
  if (areClear(uses) && roadFault(uses) === null) return null;
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
