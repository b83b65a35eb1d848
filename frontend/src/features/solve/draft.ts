/** A question while somebody puts it together: texts as they are typed, and what is asked. */

import type { Question } from "../../api/types";
import { requiredOfThese, type Requirement } from "../../lab/requirements";
import { type Metric, fullName } from "../../server/metrics";
import { NO_RANGE, parseTyped } from "../../scenario/limits";
import type { NumberField } from "../../scenario/schema";
import { SEED, type SweepField } from "../../scenario/fields";
import { prettyUnit, formatInput } from "../../units/format";
import { parseQuantity, unitBehind } from "../../units/quantity";

/** In place of a metric: all of the lab's requirements have to hold. */
export const ALL = "requirements";

/** What a strategy is held to, and what its changes are against. */
export interface Held {
  readonly requirements: readonly Requirement[];
  readonly baseline: string;
}

export interface SolveDraft {
  /** Its dotted name. */
  readonly field: string;
  readonly from: string;
  readonly to: string;
  readonly strategy: string;
  readonly metric: string;
  /** In the unit the metric is shown in. */
  readonly limit: string;
  /** How many are driven. */
  readonly roads: string;
}

/** A field, and the ends of the range that it opens with. */
export type Range = Pick<SolveDraft, "field" | "from" | "to">;

/** Another field of the same kind in its place: an end that somebody has typed stays. */
export const otherField = (draft: Range, before: Range, after: Range): Range => ({
  field: after.field,
  from: draft.from === before.from ? after.from : draft.from,
  to: draft.to === before.to ? after.to : draft.to,
});

type Typed = "from" | "to" | "limit" | "roads";

/** What is asked, or what has to be changed first at each field. */
export interface ParsedDraft {
  readonly question: Question | null;
  readonly wrong: Partial<Readonly<Record<Typed, string>>>;
  /** What does not depend on the limit: over which values, on how many roads. */
  readonly driven: Pick<Question, "range" | "roads"> | null;
}

const MOST_ROADS = 50;

export const askable = ({ name, leaf }: SweepField): boolean => leaf.kind === "number" && name !== SEED;

/** `held` where all requirements have to hold, in place of a limit of the figure. */
export function readDraft(draft: SolveDraft, field: NumberField, figure: Metric | Held): ParsedDraft {
  const [from, to] = [parseTyped(field, draft.from), parseTyped(field, draft.to)];
  const roads = Number(draft.roads);
  const wrong: Partial<Record<Typed, string>> = {};
  if (!from.ok) wrong.from = from.message;
  if (!to.ok) wrong.to = to.message;
  if (from.ok && to.ok && from.value >= to.value) wrong.from = NO_RANGE;
  if (!Number.isInteger(roads) || roads < 1 || roads > MOST_ROADS)
    wrong.roads = `A whole number from 1 to ${MOST_ROADS}`;
  const isDriven = from.ok && to.ok && !wrong.from && !wrong.roads;
  const driven = isDriven ? { range: [from.value, to.value] as [number, number], roads } : null;
  const { field: name, strategy } = draft;
  const asked = "unit" in figure ? limitOf(draft, figure) : requirementsOf(strategy, figure);
  if (typeof asked === "string") wrong.limit = asked;
  if (!driven || typeof asked === "string" || Object.keys(wrong).length > 0) return { question: null, wrong, driven };
  return { question: { field: name, strategy, ...asked, ...driven }, wrong, driven };
}

type Asked = Pick<Question, "metric" | "limit" | "requirements" | "baseline"> | string;

/** What has to hold, or what is wrong with it. */
function limitOf({ metric, limit: typed }: SolveDraft, { unit, scale }: Metric): Asked {
  const limit = parseQuantity(typed, unit);
  if (typed.trim() === "")
    return prettyUnit(unit) === "" ? "Enter the limit" : `Enter the limit in ${prettyUnit(unit)}`;
  return limit.ok ? { metric, limit: Number((limit.value / scale).toPrecision(12)) } : limit.message;
}

function requirementsOf(strategy: string, { requirements, baseline }: Held): Asked {
  const asked = requiredOfThese(requirements, [strategy], baseline);
  return asked.requirements ? { ...asked, baseline } : "None of the lab’s requirements is about this strategy";
}

const NUMBER = String.raw`-?\d[\d.]*(?:e[+-]?\d+)?`;

/** The service's sentences, which are in the units of the API, in the names and units of the page. */
export function translateUnits(text: string, { name, title, leaf }: SweepField, figure: Metric | undefined): string {
  const named = (figure ? text.replaceAll(figure.key, fullName(figure)) : text).replaceAll(name, title);
  const converted = leaf.kind === "number" ? inUnit(named, leaf.unit, leaf.shown.unit, leaf.shown.scale) : named;
  return figure ? inUnit(converted, unitBehind(figure), figure.unit, figure.scale) : converted;
}

/** `0.08 to 0.1 m` and `0.1 m` in another unit. */
function inUnit(text: string, from: string, to: string, scale: number): string {
  if (from === "1") return text;
  const escaped = from.replace(/[.*+?^${}()|[\]\\]/g, String.raw`\$&`);
  const shown = (number: string) => formatInput(Number((Number(number) * scale).toPrecision(6)));
  return text.replace(
    new RegExp(`(${NUMBER})( to (${NUMBER}))? ${escaped}(?![\\w^/·])`, "g"),
    (_, first: string, more: string | undefined, last: string) =>
      `${shown(first)}${more === undefined ? "" : ` to ${shown(last)}`}\u00a0${prettyUnit(to)}`,
  );
}
