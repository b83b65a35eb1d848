/** Where an error of the server belongs in the form. */

import type { FieldError } from "../api/problem";
import type { Pointer } from "./path";
import { leavesOf } from "./differences";
import type { Group } from "./schema";

export interface ErrorsByField {
  /** By field of the form. */
  readonly fields: Readonly<Record<Pointer, string>>;
  /** What belongs to no field. */
  readonly general: readonly string[];
}

const SCENARIO = "/scenario";

/** Finds the field for a pointer into the request: itself, the nearest one above it, or the first one below it. */
export function fieldFor(root: Group, pointer: string): Pointer | null {
  if (!pointer.startsWith(`${SCENARIO}/`)) return null;
  const inside = pointer.slice(SCENARIO.length);
  const pointers = leavesOf(root).map((leaf) => leaf.pointer);
  const above = pointers.find((candidate) => inside === candidate || inside.startsWith(`${candidate}/`));
  return above ?? pointers.find((candidate) => candidate.startsWith(`${inside}/`)) ?? null;
}

export function errorsByField(root: Group, errors: readonly FieldError[], fallback: string): ErrorsByField {
  const fields: Record<Pointer, string> = {};
  const general: string[] = [];
  for (const { pointer, message } of errors) {
    const field = fieldFor(root, pointer);
    if (field === null) general.push(message);
    else fields[field] = fields[field] === undefined ? message : `${fields[field]}. ${message}`;
  }
  if (errors.length === 0) general.push(fallback);
  return { fields, general };
}
