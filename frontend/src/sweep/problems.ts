/** Where an error of the server belongs in the dialog. */

import type { FieldError } from "../api/problem";
import type { DraftErrors } from "./draft";

export interface PlacedProblems {
  readonly fields: DraftErrors;
  /** What belongs to no field of the dialog. */
  readonly general: readonly string[];
}

const unescape = (part: string) => part.replace(/~1/g, "/").replace(/~0/g, "~");

function placeOf(pointer: string, names: readonly string[]): string | null {
  const [, root, form, ...rest] = pointer.split("/").map(unescape);
  if (root === "strategies") return "strategies";
  if (root !== "sweep") return null;
  const name = form === "grid" ? rest[0] : rest[0] === "ranges" ? rest[1] : rest[0];
  return name !== undefined && (names.includes(name) || name === "samples" || name === "seed") ? name : null;
}

export function placeProblems(errors: readonly FieldError[], names: readonly string[], fallback: string): PlacedProblems {
  const fields: Record<string, string> = {};
  const general: string[] = [];
  for (const { pointer, message } of errors) {
    const place = placeOf(pointer, names);
    if (place === null) general.push(pointer.startsWith("/scenario/") ? `The scenario’s ${pointer.slice(10).replace(/\//g, ".")}: ${message}` : message);
    else fields[place] ??= message;
  }
  return { fields, general: errors.length === 0 ? [fallback] : [...new Set(general)] };
}
