/** What a file holds, seen from its content, and what an item is exported as. */

import type { JsonObject } from "../api/types";
import { download } from "../ui/download";
import type { Item } from "./library";

export type Content = { readonly kind: "scenario" | "vehicle"; readonly value: JsonObject; readonly label: string | null } | { readonly kind: "road"; readonly csv: string };

const isObject = (value: unknown): value is JsonObject => typeof value === "object" && value !== null && !Array.isArray(value);

const EXPECTED = "Expected a scenario or a vehicle as JSON, or a measured road as CSV with a line of titles";

/**
 * What a file holds. A run holds its scenario.
 * @param parts Names of the scenario's parts.
 * @throws {Error} Its message says what was expected; the values are for the server to check.
 */
export function readFile(name: string, text: string, parts: readonly string[]): Content {
  if (!/\.json$/i.test(name) && !/^\s*[[{]/.test(text)) {
    const [titles = "", first = ""] = text.split("\n").filter((line) => !/^\s*(#|$)/.test(line));
    if (/[,;\t]/.test(titles) && /^\s*["'+-]?[\d.,]/.test(first)) return { kind: "road", csv: text };
    throw new Error(EXPECTED);
  }
  const content = parsed(text);
  const scenario = isObject(content) && isObject(content.scenario) ? content.scenario : content;
  if (!isObject(scenario) || !isObject(content)) throw new Error(EXPECTED);
  const named = Object.keys(scenario).filter((part) => parts.includes(part));
  const label = typeof content.label === "string" ? content.label : null;
  if (scenario === content && named.join() === "vehicle" && isObject(scenario.vehicle)) return { kind: "vehicle", value: scenario.vehicle, label };
  if (named.length === 0) throw new Error(`${EXPECTED}. A scenario has one of the members ${parts.join(", ")}`);
  return { kind: "scenario", value: scenario, label };
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Error(`This file is not JSON. ${error instanceof Error ? error.message : ""}`, { cause: error });
  }
}

/** As the API and the command line take it. */
export function fileOf({ kind, name, value }: Pick<Item, "kind" | "name" | "value">): { readonly name: string; readonly text: string } {
  const content = kind === "vehicle" ? { label: name, vehicle: value } : value;
  return { name: `${name.replace(/[^\p{L}\p{N} ().,_-]+/gu, "_")}.json`, text: `${JSON.stringify(content, null, 1)}\n` };
}

export function exportItem(item: Pick<Item, "kind" | "name" | "value">): void {
  const { name, text } = fileOf(item);
  const address = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  download(address, name);
  URL.revokeObjectURL(address);
}
