/** The service's sentences, which are in the units of the API, in the names and units of the page. */

import { fullName, type Figure } from "../../server/metrics";
import type { SweepField } from "../../scenario/fields";
import { formatInput, prettyUnit } from "../../units/format";
import { unitBehind } from "../../units/quantity";

const NUMBER = String.raw`-?\d[\d.]*(?:e[+-]?\d+)?`;

export function inPageUnits(text: string, { name, title, leaf }: SweepField, figure: Figure): string {
  const named = text.replaceAll(figure.key, fullName(figure)).replaceAll(name, title);
  const converted = leaf.kind === "number" ? inUnit(named, leaf.unit, leaf.shown.unit, leaf.shown.scale) : named;
  return inUnit(converted, unitBehind(figure), figure.unit, figure.scale);
}

/** `0.08 to 0.1 m` and `0.1 m` in another unit. */
function inUnit(text: string, from: string, to: string, scale: number): string {
  if (from === "1") return text;
  const escaped = from.replace(/[.*+?^${}()|[\]\\]/g, String.raw`\$&`);
  const shown = (number: string) => formatInput(Number((Number(number) * scale).toPrecision(6)));
  return text.replace(
    new RegExp(`(${NUMBER})( to (${NUMBER}))? ${escaped}(?![\\w^/·])`, "g"),
    (_, first: string, more: string | undefined, last: string) =>
      `${shown(first)}${more === undefined ? "" : ` to ${shown(last)}`}\u00a0${prettyUnit(to)}`,
  );
}
