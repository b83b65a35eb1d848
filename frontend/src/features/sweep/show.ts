/** A row's values as a person reads them. */

import { humanise } from "../../scenario/schema";
import { formatExact, formatResult } from "../../units/format";
import type { Cell } from "./table";

/** A swept value: with all the digits that tell it from its neighbours. */
export function showCell(value: Cell, unit = "1"): string {
  if (typeof value === "number") return formatExact(Number(value.toPrecision(6)), unit);
  if (typeof value === "string") return humanise(value);
  if (Array.isArray(value)) return value.map((each) => formatExact(Number(each), "1")).join(", ");
  return "off";
}

export function showFigure(value: Cell, scale: number): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  return typeof value === "number" ? formatResult(value * scale, 4) : "–";
}
