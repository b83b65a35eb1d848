/** Where an error of the server belongs in a form. */

import type { FieldError } from "../../api/problem";

/** By the name a form gives its field. */
export type DraftErrors = Readonly<Record<string, string>>;

export interface ProblemsByField {
  readonly fields: DraftErrors;
  /** What belongs to no field of the form. */
  readonly general: readonly string[];
}

/** The form's own name for what a pointer's parts lead to; null where it has no such field. */
export type FieldNameOf = (parts: readonly string[]) => string | null;

const unescape = (part: string) => part.replace(/~1/g, "/").replace(/~0/g, "~");

export function problemsByField(
  errors: readonly FieldError[],
  fieldNameOf: FieldNameOf,
  fallback: string,
): ProblemsByField {
  const fields: Record<string, string> = {};
  const general: string[] = [];
  for (const { pointer, message } of errors) {
    const parts = pointer.split("/").slice(1).map(unescape);
    const name = fieldNameOf(parts);
    if (name !== null) fields[name] ??= message;
    else
      general.push(
        parts[0] === "scenario" && parts.length > 1
          ? `The scenario’s ${parts.slice(1).join(".")}: ${message}`
          : message,
      );
  }
  return { fields, general: errors.length === 0 ? [fallback] : [...new Set(general)] };
}
