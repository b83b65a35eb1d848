/** A tuning while somebody puts it together: texts as they are typed, and what becomes of them. */

import type { StrategyId, TuningChoice } from "../../api/types";
import type { Metric } from "../../server/metrics";
import { typedText } from "../../scenario/limits";
import type { Group } from "../../scenario/schema";
import { isLike } from "../../lib/storage";
import {
  readForm,
  readRange,
  readWhole,
  type FieldNameOf,
  type Parsed,
  type Put,
} from "../../features/jobForm/jobForm";
import { formatInput, parseInput } from "../../units/format";
import { parseQuantity } from "../../units/quantity";
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

function objectives({ objectives: drafts }: TuningDraft, put: Put): NonNullable<TuningChoice["objectives"]> {
  if (drafts.length === 0) put("objectives", "Add an objective");
  return drafts.map(({ kind, q, window, figure }, index) => {
    if (kind === "figure") return { kind, figure };
    const coefficients = q.map((text) => parseInput(text) ?? NaN);
    if (!coefficients.every((value) => value >= 0 && value <= 1000))
      put(`objectives.${index}`, "Each coefficient is a number from 0 to 1000");
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
    searched.map(({ name, field, range }) => [
      name,
      readRange(field, range, (message) => put(`search.${name}`, message)),
    ]),
  );
}

function roads(text: string, field: string, least: number, put: Put): readonly number[] {
  const parsed = readSeeds(text, MOST_ROADS);
  if (!parsed.ok) put(field, parsed.message);
  else if (parsed.seeds.length < least) put(field, `At least ${least} roads: a mean needs a spread beside it`);
  return parsed.ok ? parsed.seeds : [];
}

/** Errors by field: `objectives.0`, `limits.1`, `search.mpc.stage_weights.bump.0`, `seeds`, `trials`, … */
export const readDraft = (
  draft: TuningDraft,
  numbers: readonly TunableNumber[],
  figures: readonly Metric[],
): Parsed<TuningChoice> =>
  readForm((put) => {
    const seeds = roads(draft.seeds, "seeds", 1, put);
    const validation = roads(draft.validationSeeds, "fresh_seeds", 2, put);
    if (validation.some((seed) => seeds.includes(seed)))
      put("fresh_seeds", "A validation road must not be a training road");
    const whole = (key: "trials" | "population" | "seed", what: string, least: number, most: number) =>
      readWhole(draft[key], [least, most], (message) => put(key, message), what);
    return {
      strategy: draft.strategy,
      objectives: objectives(draft, put),
      limits: limits(draft, figures, put),
      search: search(draft, numbers, put),
      ...(draft.previews.length > 1 ? { previews: draft.previews } : {}),
      ...(draft.uncertain ? { uncertain: true } : {}),
      ...(draft.quantile === "" ? {} : { quantile: Number(draft.quantile) }),
      seeds,
      fresh_seeds: validation,
      trials: whole("trials", "Trials", 1, MOST_TRIALS),
      population: whole("population", "Population size", 1, MOST_POPULATION),
      seed: whole("seed", "Search seed", 0, LARGEST_SEED),
    };
  });

/** A limit starts at what the figure may not exceed by its own sense: nothing. */
export const limitOf = (figure: string): LimitDraft => ({ figure, atMost: formatInput(0) });

type Seeds =
  | { readonly ok: true; readonly seeds: readonly number[] }
  | { readonly ok: false; readonly message: string };

const LARGEST_SEED = 2 ** 32 - 1;

export function readSeeds(text: string, most: number): Seeds {
  const parts = text.split(/[,;\s]+/).filter((part) => part !== "");
  if (parts.length === 0) return { ok: false, message: "Needs at least one road" };
  const seeds = new Set<number>();
  for (const part of parts) {
    const [, first, last] = /^(\d+)(?:[-–](\d+))?$/.exec(part) ?? [];
    const [from, to] = [Number(first), Number(last ?? first)];
    if (first === undefined || from > LARGEST_SEED || to > LARGEST_SEED)
      return { ok: false, message: `Not a seed: ${part}. Whole numbers and ranges, such as 1-4, 7` };
    if (to < from) return { ok: false, message: `${part} runs backwards` };
    if (to - from >= most) return { ok: false, message: `At most ${most} roads` };
    for (let seed = from; seed <= to; seed += 1) seeds.add(seed);
  }
  return seeds.size > most ? { ok: false, message: `At most ${most} roads` } : { ok: true, seeds: [...seeds] };
}

/** Neighbours as a range: `1-4, 7`. */
export function formatSeeds(seeds: readonly number[]): string {
  const parts: string[] = [];
  for (let start = 0; start < seeds.length;) {
    let end = start;
    while (seeds[end + 1] === (seeds[end] ?? NaN) + 1) end += 1;
    const [first, last] = [String(seeds[start]), String(seeds[end])];
    parts.push(...(end - start >= 2 ? [`${first}-${last}`] : end > start ? [first, last] : [first]));
    start = end + 1;
  }
  return parts.join(", ");
}
