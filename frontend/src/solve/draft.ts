/** A question while somebody puts it together: texts as they are typed, and what is asked. */

import type { Question } from "../api/types";
import type { Figure } from "../batch/figures";
import { parseTyped } from "../editor/limits";
import type { NumberField } from "../editor/schema";
import type { SweepField } from "../sweep/fields";
import { parseQuantity } from "../units/quantity";

export interface SolveDraft {
  /** Its dotted name. */
  readonly field: string;
  readonly from: string;
  readonly to: string;
  readonly strategy: string;
  readonly metric: string;
  /** In the unit the metric is shown in. */
  readonly limit: string;
}

/** What is asked, or what has to be changed first; neither while the limit is missing. */
export interface ParsedDraft {
  readonly question: Question | null;
  readonly wrong: string | null;
}

/** A greater seed is another road, not more of anything. */
const UNORDERED = "road.seed";

export const askable = ({ name, leaf }: SweepField): boolean => leaf.kind === "number" && name !== UNORDERED;

export function readDraft(draft: SolveDraft, field: NumberField, figure: Figure): ParsedDraft {
  const ends = [draft.from, draft.to].map((text) => parseTyped(field, text));
  const [from, to] = ends;
  const limit = parseQuantity(draft.limit, figure.unit);
  const wrong = (message: string): ParsedDraft => ({ question: null, wrong: message });
  if (from?.ok === false) return wrong(`From: ${from.message}`);
  if (to?.ok === false) return wrong(`To: ${to.message}`);
  if (!from || !to || from.value >= to.value) return wrong("From has to be less than to");
  if (draft.limit.trim() === "") return { question: null, wrong: null };
  if (!limit.ok) return wrong(`At most: ${limit.message}`);
  const { strategy, metric } = draft;
  return { question: { field: draft.field, strategy, metric, range: [from.value, to.value], limit: Number((limit.value / figure.scale).toPrecision(12)) }, wrong: null };
}
