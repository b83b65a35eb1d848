/** Where an error of the server belongs in the form. */

import type { FieldError } from "../api/problem";
import type { DraftErrors } from "./draft";

export interface PlacedProblems {
  readonly fields: DraftErrors;
  /** What belongs to no field of the form. */
  readonly general: readonly string[];
}

const unescape = (part: string) => part.replace(/~1/g, "/").replace(/~0/g, "~");
const PLAIN = ["seeds", "fresh_seeds", "trials", "population", "seed", "strategy"];

function placeOf(pointer: string): string | null {
  const [, root, second] = pointer.split("/").map(unescape);
  if (root === undefined) return null;
  if (root === "objectives" || root === "limits" || root === "search") return second === undefined ? root : `${root}.${second}`;
  return PLAIN.includes(root) ? root : null;
}

export function placeProblems(errors: readonly FieldError[], fallback: string): PlacedProblems {
  const fields: Record<string, string> = {};
  const general: string[] = [];
  for (const { pointer, message } of errors) {
    const place = placeOf(pointer);
    if (place !== null) fields[place] ??= message;
    else general.push(pointer.startsWith("/scenario/") ? `The scenario’s ${pointer.slice(10).replace(/\//g, ".")}: ${message}` : message);
  }
  return { fields, general: errors.length === 0 ? [fallback] : [...new Set(general)] };
}
