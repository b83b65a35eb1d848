/** A tuning while somebody puts it together: texts as they are typed, and what becomes of them. */

import type { StrategyId, TuningChoice } from "../../api/types";
import type { Metric } from "../../server/metrics";
import { NO_RANGE, parseTyped, typedText } from "../../scenario/limits";
import type { Group } from "../../scenario/schema";
import { isLike } from "../../lib/storage";
import type { DraftErrors, FieldNameOf } from "../../features/jobForm/problems";
import { formatInput, parseInput } from "../../units/format";
import { parseQuantity } from "../../units/quantity";
import { readSeeds } from "./seeds";
import { isTunable, numberFields, tunableOf, type TunableNumber } from "./space";
import { OWN } from "../../scenario/differences";

export type ObjectiveKind = "paper" | "peaks" | "figure";

export interface ObjectiveDraft {
  /** Of its row on the page. */
  readonly key: number;
  readonly kind: ObjectiveKind;
  readonly q: readonly [string, string, string];
  readonly window: string;
  /** Column of a figure, of that kind alone. */
  readonly figure: string | null;
}

export interface LimitDraft {
  readonly figure: string;
  /** In the figure's shown unit. */
  readonly atMost: string;
}

/** Both ends in the field's shown unit. */
export interface RangeDraft {
  readonly on: boolean;
  readonly from: string;
  readonly to: string;
}

export interface TuningDraft {
  readonly strategy: StrategyId;
  readonly objectives: readonly ObjectiveDraft[];
  readonly limits: readonly LimitDraft[];
  readonly ranges: Readonly<Record<string, RangeDraft>>;
  /** Kinds of preview tried; the scenario's where it is none or one. */
  readonly previews: readonly string[];
  readonly uncertain: boolean;
  /** Of the roads, as a number's text; empty for the mean. */
  readonly quantile: string;
  readonly seeds: string;
  readonly validationSeeds: string;
  readonly trials: string;
  readonly population: string;
  readonly seed: string;
}

/** Errors by field: `objectives.0`, `limits.1`, `search.mpc.stage_weights.bump.0`, `seeds`, `trials`, … */
export type ParsedDraft =
  | { readonly ok: true; readonly body: TuningChoice }
  | { readonly ok: false; readonly errors: DraftErrors };

const PLAIN = ["previews", "quantile", "seeds", "fresh_seeds", "trials", "population", "seed", "strategy"];

export const tuningFieldName: FieldNameOf = ([root, second]) => {
  if (root === undefined) return null;
  if (root === "objectives" || root === "limits" || root === "search")
    return second === undefined ? root : `${root}.${second}`;
  return PLAIN.includes(root) ? root : null;
};

/** Where a sum over the passive car is taken unless somebody says otherwise. */
const WINDOW_OF: Readonly<Record<ObjectiveKind, string>> = { paper: "whole", peaks: "bump", figure: "" };
export const MOST_OBJECTIVES = 3;
export const MOST_LIMITS = 8;
const MOST_ROADS = 64;
const MOST_TRIALS = 5000;
const MOST_POPULATION = 256;
const RANGE = ["0.05", "50"] as const;

export const objectiveOf = (key: number, kind: ObjectiveKind, figure: string | null = null): ObjectiveDraft => ({
  key,
  kind,
  q: ["1", "1", "1"],
  window: WINDOW_OF[kind],
  figure,
});

export function rangesFor(form: Group, strategy: StrategyId): Readonly<Record<string, RangeDraft>> {
  return Object.fromEntries(
    numberFields(tunableOf(form, strategy)).map(({ name, single, field }) => {
      const { soft, minimum, maximum } = field;
      const isOption = field.pointer.startsWith(OWN);
      const [from, to] =
        single && !name.endsWith("deflection_weight")
          ? [typedText(field, soft[0] || (isOption ? 0 : soft[1] / 100)), typedText(field, soft[1])]
          : RANGE;
      return [name, { on: isOption ? Number.isFinite(maximum - minimum) : !single, from, to }];
    }),
  );
}

export function firstDraft(form: Group, strategy: StrategyId = "lv"): TuningDraft {
  return {
    strategy,
    objectives: [objectiveOf(0, "paper")],
    limits: [],
    ranges: rangesFor(form, strategy),
    previews: [],
    uncertain: false,
    quantile: "",
    seeds: "1-4",
    validationSeeds: "101-110",
    trials: "200",
    population: "16",
    seed: "0",
  };
}

/** A stored draft, over the form's fields of today. */
export function restoreTuning(stored: unknown, form: Group): TuningDraft | null {
  if (!isLike({ strategy: "" }, stored) || !isTunable(form, stored.strategy)) return null;
  const { strategy } = stored;
  const template: TuningDraft = { ...firstDraft(form, strategy), limits: [limitOf("")] };
  if (!isLike(template, stored) || !stored.objectives.every(({ kind }) => kind in WINDOW_OF)) return null;
  return stored;
}

type Put = (field: string, message: string) => void;

function number(text: string, low: number, high: number, put: () => void): number {
  const value = parseInput(text);
  if (value === null || value < low || value > high) put();
  return value ?? low;
}

function whole(text: string, low: number, high: number, field: string, put: Put): number {
  const refuse = () => put(field, `A whole number from ${low} to ${high}`);
  const value = number(text, low, high, refuse);
  if (!Number.isInteger(value)) refuse();
  return value;
}

function objectives({ objectives: drafts }: TuningDraft, put: Put): NonNullable<TuningChoice["objectives"]> {
  if (drafts.length === 0) put("objectives", "Add an objective");
  return drafts.map(({ kind, q, window, figure }, index) => {
    if (kind === "figure") return { kind, figure };
    const coefficients = q.map((text) =>
      number(text, 0, 1000, () => put(`objectives.${index}`, "Each coefficient is a number from 0 to 1000")),
    );
    if (coefficients.every((value) => value === 0))
      put(`objectives.${index}`, "At least one coefficient must be greater than 0");
    const [first = 0, second = 0, third = 0] = coefficients;
    return { kind, q: [first, second, third], window };
  });
}

function limits(
  { limits: drafts }: TuningDraft,
  figures: readonly Metric[],
  put: Put,
): NonNullable<TuningChoice["limits"]> {
  return drafts.map(({ figure, atMost }, index) => {
    const { unit, scale } = figures.find(({ key }) => key === figure) ?? { unit: "1", scale: 1 };
    const limit = parseQuantity(atMost, unit);
    if (!limit.ok) put(`limits.${index}`, limit.message);
    return { figure, at_most: limit.ok ? Number((limit.value / scale).toPrecision(12)) : 0 };
  });
}

function search(
  { ranges }: TuningDraft,
  numbers: readonly TunableNumber[],
  put: Put,
): NonNullable<TuningChoice["search"]> {
  const searched = numbers.flatMap(({ name, field }) => {
    const range = ranges[name];
    return range?.on ? [{ name, field, range }] : [];
  });
  if (searched.length === 0) put("search", "Choose at least one");
  return Object.fromEntries(
    searched.map(({ name, field, range }) => {
      const end = (text: string) => {
        const parsed = parseTyped(field, text);
        if (!parsed.ok) put(`search.${name}`, parsed.message);
        return parsed.ok ? parsed.value : NaN;
      };
      const ends = [end(range.from), end(range.to)] as const;
      if (ends[0] >= ends[1]) put(`search.${name}`, NO_RANGE);
      return [name, ends];
    }),
  );
}

function roads(text: string, field: string, least: number, put: Put): readonly number[] {
  const parsed = readSeeds(text, MOST_ROADS);
  if (!parsed.ok) put(field, parsed.message);
  else if (parsed.seeds.length < least) put(field, `At least ${least} roads: a mean needs a spread beside it`);
  return parsed.ok ? parsed.seeds : [];
}

/** What is sent, or what has to be changed first. */
export function readDraft(
  draft: TuningDraft,
  numbers: readonly TunableNumber[],
  figures: readonly Metric[],
): ParsedDraft {
  const errors: Record<string, string> = {};
  const put: Put = (field, message) => void (errors[field] ??= message);
  const seeds = roads(draft.seeds, "seeds", 1, put);
  const validation = roads(draft.validationSeeds, "fresh_seeds", 2, put);
  if (validation.some((seed) => seeds.includes(seed)))
    put("fresh_seeds", "A validation road must not be a training road");
  const body: TuningChoice = {
    strategy: draft.strategy,
    objectives: objectives(draft, put),
    limits: limits(draft, figures, put),
    search: search(draft, numbers, put),
    ...(draft.previews.length > 1 ? { previews: draft.previews } : {}),
    ...(draft.uncertain ? { uncertain: true } : {}),
    ...(draft.quantile === "" ? {} : { quantile: Number(draft.quantile) }),
    seeds,
    fresh_seeds: validation,
    trials: whole(draft.trials, 1, MOST_TRIALS, "trials", put),
    population: whole(draft.population, 1, MOST_POPULATION, "population", put),
    seed: whole(draft.seed, 0, 2 ** 32 - 1, "seed", put),
  };
  return Object.keys(errors).length > 0 ? { ok: false, errors } : { ok: true, body };
}

/** A limit starts at what the figure may not exceed by its own sense: nothing. */
export const limitOf = (figure: string): LimitDraft => ({ figure, atMost: formatInput(0) });
