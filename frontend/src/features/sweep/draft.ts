/** A sweep while somebody puts it together: texts as they are typed, and what becomes of them. */

import { spansDecades } from "../../lib/steps";
import type { StrategyId, Sweep } from "../../api/types";
import { NO_RANGE, parseTyped, typedText } from "../../scenario/limits";
import { optionValue, type NumberField } from "../../scenario/schema";
import type { DraftErrors } from "../jobForm/problems";
import { isLike } from "../../lib/storage";
import { parseInput } from "../../units/format";
import type { SweepField } from "../../scenario/fields";

export type Method = "grid" | "hypercube";

export interface FieldDraft {
  readonly field: SweepField;
  /** How a grid's values are given. */
  readonly by: "steps" | "list";
  readonly from: string;
  readonly to: string;
  readonly count: string;
  readonly list: string;
  readonly options: readonly string[];
  /** Further fields that take the same value. */
  readonly linked: readonly SweepField[];
}

export interface SweepDraft {
  readonly method: Method;
  readonly fields: readonly FieldDraft[];
  readonly samples: string;
  readonly seed: string;
  readonly strategies: readonly StrategyId[];
}

/** Errors by dotted name, or by `samples`, `seed`, `strategies`, `fields`. */
export type ParsedDraft =
  | { readonly ok: true; readonly sweep: Sweep }
  | { readonly ok: false; readonly errors: DraftErrors };

const DEFAULT_COUNT = 5;
const MOST_VALUES = 10_000;

export function draftField(field: SweepField): FieldDraft {
  const { leaf } = field;
  const [low, high] = leaf.kind === "number" ? leaf.soft : [0, 0];
  return {
    field,
    by: "steps",
    from: leaf.kind === "number" ? typedText(leaf, low) : "",
    to: leaf.kind === "number" ? typedText(leaf, high) : "",
    count: String(leaf.kind === "number" && leaf.integer ? Math.min(DEFAULT_COUNT, high - low + 1) : DEFAULT_COUNT),
    list: "",
    options: leaf.kind === "choice" ? leaf.options : [],
    linked: [],
  };
}

/** A stored draft, over the form's fields of today. */
export function restoreSweep(stored: unknown, fields: readonly SweepField[]): SweepDraft | null {
  const name = { name: "" };
  const field = { field: name, by: "", from: "", to: "", count: "", list: "", options: [""], linked: [name] };
  if (!isLike({ method: "", fields: [field], samples: "", seed: "", strategies: [""] }, stored)) return null;
  const find = (each: typeof name) => fields.find((match) => match.name === each.name) ?? [];
  const { samples, seed, strategies } = stored;
  return {
    method: stored.method === "hypercube" ? "hypercube" : "grid",
    fields: stored.fields.flatMap((each) =>
      [find(each.field)].flat().map((match): FieldDraft => ({
        ...each,
        field: match,
        by: each.by === "list" ? "list" : "steps",
        linked: each.linked.flatMap(find),
      })),
    ),
    samples,
    seed,
    strategies,
  };
}

/** Whether values are spread by equal ratios, as the field's slider is. */
export const byRatio = ({ soft: [low, high] }: NumberField) => spansDecades(low, high);

/** `count` values from `from` to `to`, both included; whole numbers, each once, for fields that take only those. */
export function spread(field: NumberField, from: number, to: number, count: number): readonly number[] {
  const ratio = byRatio(field) && from > 0 && to > 0;
  const at = (part: number) => (ratio ? from * (to / from) ** part : from + (to - from) * part);
  const values = Array.from({ length: count }, (_, index) =>
    Number(at(count === 1 ? 0 : index / (count - 1)).toPrecision(8)),
  );
  return field.integer ? [...new Set(values.map(Math.round))] : values;
}

class FieldError extends Error {}

function typed(field: NumberField, text: string, what: string): number {
  const parsed = parseTyped(field, text);
  if (!parsed.ok) throw new FieldError(`${what}: ${lowerFirst(parsed.message)}`);
  return parsed.value;
}

const lowerFirst = (text: string) => text.charAt(0).toLowerCase() + text.slice(1);

function wholeNumber(text: string, least: number, most: number, what: string): number {
  const value = parseInput(text);
  if (value === null || !Number.isInteger(value) || value < least || value > most) {
    throw new FieldError(`${what}: a whole number from ${least} to ${most}`);
  }
  return value;
}

function rangeOf(field: NumberField, draft: FieldDraft): readonly [number, number] {
  const ends = [typed(field, draft.from, "From"), typed(field, draft.to, "To")] as const;
  if (ends[0] >= ends[1]) throw new FieldError(NO_RANGE);
  return ends;
}

function gridValues(draft: FieldDraft): readonly (number | string | boolean)[] {
  const { leaf } = draft.field;
  if (leaf.kind === "choice") {
    if (draft.options.length === 0) throw new FieldError("Choose at least one");
    return leaf.options.filter((option) => draft.options.includes(option)).map((option) => optionValue(leaf, option));
  }
  if (draft.by === "list") {
    const texts = draft.list
      .split(/[;,\n]|\s+(?=[+\-−.\d])/)
      .map((text) => text.trim())
      .filter((text) => text !== "");
    if (texts.length === 0) throw new FieldError("Needs at least one value");
    return texts.map((text) => typed(leaf, text, text));
  }
  const count = wholeNumber(draft.count, 1, MOST_VALUES, "Values");
  if (count === 1) return [typed(leaf, draft.from, "From")];
  return spread(leaf, ...rangeOf(leaf, draft), count);
}

/** What is sent, or what has to be changed first. */
export function readDraft(draft: SweepDraft): ParsedDraft {
  const errors: Record<string, string> = {};
  const attempt = <T>(name: string, read: () => T): T | undefined => {
    try {
      return read();
    } catch (error) {
      if (!(error instanceof FieldError)) throw error;
      errors[name] = error.message;
      return undefined;
    }
  };
  if (draft.fields.length === 0) errors.fields = "Add a field to sweep";
  if (draft.strategies.length === 0) errors.strategies = "Choose at least one strategy";
  const links = draft.fields
    .filter(({ linked }) => linked.length > 0)
    .map(({ field, linked }) => [field.name, linked.map(({ name }) => name)] as const);
  const sweep = {
    ...(draft.method === "grid" ? grid(draft, attempt) : hypercube(draft, attempt)),
    ...(links.length > 0 ? { linked: Object.fromEntries(links) } : {}),
  };
  return Object.keys(errors).length > 0 ? { ok: false, errors } : { ok: true, sweep };
}

type Attempt = <T>(name: string, read: () => T) => T | undefined;

function grid({ fields }: SweepDraft, attempt: Attempt): Sweep {
  return {
    grid: Object.fromEntries(
      fields.map((draft) => [draft.field.name, attempt(draft.field.name, () => gridValues(draft)) ?? []]),
    ),
  };
}

function hypercube({ fields, samples, seed }: SweepDraft, attempt: Attempt): Sweep {
  const ranges = fields.map(({ field, ...draft }) => {
    const range = attempt(field.name, () => {
      if (field.leaf.kind === "choice")
        throw new FieldError("A Latin hypercube needs numbers: sweep this one in a grid");
      return rangeOf(field.leaf, { field, ...draft });
    });
    return [field.name, [...(range ?? [])]] as const;
  });
  return {
    latin_hypercube: {
      ranges: Object.fromEntries(ranges),
      samples: attempt("samples", () => wholeNumber(samples, 1, 1_000_000, "Samples")) ?? 1,
      seed: attempt("seed", () => wholeNumber(seed, 0, 2 ** 32 - 1, "Seed")) ?? 0,
    },
  };
}
