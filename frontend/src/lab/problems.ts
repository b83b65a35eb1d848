/** What went wrong with a request of the lab: at a field, in a notice, or for want of a server. */

import { ApiProblem, isAbort, isNotFound, isTransient } from "../api/problem";
import type { Group } from "../scenario/schema";
import type { LabState } from "./labState";
import { errorsByField, type ErrorsByField } from "../scenario/fields";

export const NO_ERRORS: ErrorsByField = { fields: {}, general: [] };

export const hasErrors = ({ fields, general }: ErrorsByField) => general.length > 0 || Object.keys(fields).length > 0;

type Change = Partial<Pick<LabState, "serverErrors" | "failure">>;

/** What the server refuses: at its field, where it names one. */
export function refusal(problem: ApiProblem, form: Group | null): Change {
  if (problem.status === 422 && form) return { serverErrors: errorsByField(form, problem.errors, problem.message) };
  return { failure: { kind: "failed", message: problem.message } };
}

/** What to show for it; nothing for what was aborted. */
export function problemOf(error: unknown, form: Group | null): Change {
  if (isAbort(error)) return {};
  if (isTransient(error)) return { failure: { kind: "unreachable" } };
  if (isNotFound(error)) return { failure: { kind: "notFound" } };
  if (error instanceof ApiProblem) return refusal(error, form);
  return { failure: { kind: "failed", message: error instanceof Error ? error.message : "Something went wrong" } };
}
