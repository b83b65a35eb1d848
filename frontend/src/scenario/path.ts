/** Addresses of values inside a scenario: JSON pointers such as `/road/bump/height`. */

import type { JsonObject, JsonValue, Scenario } from "../api/types";

export type Pointer = `/${string}`;

export function isObject(value: unknown): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** A form has some hundred pointers, and every one is followed at every step of a slider. */
const SPLIT = new Map<Pointer, readonly string[]>();

function keys(pointer: Pointer): readonly string[] {
  const cached = SPLIT.get(pointer);
  if (cached) return cached;
  const split = pointer
    .slice(1)
    .split("/")
    .map((key) => key.replace(/~1/g, "/").replace(/~0/g, "~"));
  SPLIT.set(pointer, split);
  return split;
}

export function child(parent: Pointer | "", key: string | number): Pointer {
  return `${parent}/${String(key).replace(/~/g, "~0").replace(/\//g, "~1")}`;
}

export function getAt(root: JsonValue | undefined, pointer: Pointer): JsonValue | undefined {
  let value: JsonValue | undefined = root;
  for (const key of keys(pointer)) {
    if (Array.isArray(value)) value = (value as readonly JsonValue[])[Number(key)];
    else if (isObject(value)) value = value[key];
    else return undefined;
  }
  return value;
}

/** A copy of the scenario with one value replaced; everything else is shared. */
export function setAt(scenario: Scenario, pointer: Pointer, value: JsonValue): Scenario {
  const write = (node: JsonValue | undefined, path: readonly string[]): JsonValue => {
    const [key, ...rest] = path;
    if (key === undefined) return value;
    if (Array.isArray(node)) {
      return (node as readonly JsonValue[]).map((item, index) => (String(index) === key ? write(item, rest) : item));
    }
    const object = isObject(node) ? node : {};
    return { ...object, [key]: write(object[key], rest) };
  };
  return write(scenario, keys(pointer)) as Scenario;
}

export function sameValue(a: JsonValue | undefined, b: JsonValue | undefined): boolean {
  if (a === b) return true;
  if (Array.isArray(a) && Array.isArray(b)) {
    const [left, right] = [a, b] as [readonly JsonValue[], readonly JsonValue[]];
    return left.length === right.length && left.every((item, index) => sameValue(item, right[index]));
  }
  if (isObject(a) && isObject(b)) {
    const names = Object.keys(a);
    return names.length === Object.keys(b).length && names.every((name) => sameValue(a[name], b[name]));
  }
  return false;
}

/** A number of the scenario; `otherwise` where it is not there. */
export function numberAt(scenario: Scenario, pointer: Pointer, otherwise: number): number {
  const value = getAt(scenario, pointer);
  return typeof value === "number" ? value : otherwise;
}
