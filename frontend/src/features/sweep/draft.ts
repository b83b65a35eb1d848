/** A sweep while somebody puts it together: texts as they are typed, and what becomes of them. */

import { spansDecades } from "../../lib/steps";
import type { StrategyId, Sweep } from "../../api/types";
import { typedText } from "../../scenario/limits";
import { optionValue, type NumberField } from "../../scenario/schema";
import { readForm, readNumber, readRange, readWhole, type Parsed, type Put } from "../jobForm/jobForm";
import { isLike } from "../../lib/storage";
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
}

export interface SweepDraft {
  readonly method: Method;
  readonly fields: readonly FieldDraft[];
  readonly samples: string;
  readonly seed: string;
  readonly strategies: readonly StrategyId[];
}

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
  };
}

/** A stored draft, over the form's fields of today. */
export function restoreSweep(stored: unknown, fields: readonly SweepField[]): SweepDraft | null {
  const name = { name: "" };
  const field = { field: name, by: "", from: "", to: "", count: "", list: "", options: [""] };
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

function gridValues(draft: FieldDraft, put: (message: string) => void): readonly (number | string | boolean)[] {
  const { leaf } = draft.field;
  if (leaf.kind === "choice") {
    if (draft.options.length === 0) put("Choose at least one");
    return leaf.options.filter((option) => draft.options.includes(option)).map((option) => optionValue(leaf, option));
  }
  if (draft.by === "list") {
    const texts = draft.list
      .split(/[;,\n]|\s+(?=[+\-−.\d])/)
      .map((text) => text.trim())
      .filter((text) => text !== "");
    if (texts.length === 0) put("Needs at least one value");
    return texts.map((text) => readNumber(leaf, text, put, text));
  }
  const count = readWhole(draft.count, [1, MOST_VALUES], put, "Values");
  if (!(count > 1)) return [readNumber(leaf, draft.from, put, "From")];
  return spread(leaf, ...readRange(leaf, draft, put), Math.min(count, MOST_VALUES));
}

/** Errors by dotted name, or by `samples`, `seed`, `strategies`, `fields`. */
export const readDraft = (draft: SweepDraft): Parsed<Sweep> =>
  readForm((put) => {
    const { method, fields, strategies } = draft;
    if (fields.length === 0) put("fields", "Add a field to sweep");
    if (strategies.length === 0) put("strategies", "Choose at least one strategy");
    return method === "grid" ? grid(draft, put) : hypercube(draft, put);
  });

const grid = ({ fields }: SweepDraft, put: Put): Sweep => ({
  grid: Object.fromEntries(
    fields.map((draft) => {
      const { name } = draft.field;
      return [name, gridValues(draft, (message) => put(name, message))];
    }),
  ),
});

function hypercube({ fields, samples, seed }: SweepDraft, put: Put): Sweep {
  const ranges = fields.map(({ field: { name, leaf }, ...ends }): readonly [string, readonly number[]] => {
    if (leaf.kind === "number") return [name, readRange(leaf, ends, (message) => put(name, message))];
    put(name, "A Latin hypercube needs numbers: sweep this one in a grid");
    return [name, []];
  });
  return {
    latin_hypercube: {
      ranges: Object.fromEntries(ranges),
      samples: readWhole(samples, [1, 1_000_000], (message) => put("samples", message), "Samples"),
      seed: readWhole(seed, [0, 2 ** 32 - 1], (message) => put("seed", message), "Seed"),
    },
  };
}
