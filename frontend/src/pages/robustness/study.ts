/** A robustness study while somebody puts it together, the batches that come of it, and what their summary holds. */

import type { Batch, RobustnessDefaults, Scenario, StrategyId, Sweep, BatchSummary, Strategy } from "../../api/types";
import { typedText, valueText } from "../../scenario/limits";
import { getAt } from "../../scenario/path";
import type { Group } from "../../scenario/schema";
import { isLike } from "../../lib/storage";
import type { Parsed } from "../../features/jobForm/jobForm";
import { draftField, readDraft } from "../../features/sweep/draft";
import { sweepFields, type SweepField } from "../../scenario/fields";
import { keepPreviousData, queryOptions } from "@tanstack/react-query";
import { ask } from "../../api/http";
import { isFinal } from "../../jobs/useJob";
import type { Metric } from "../../server/metrics";
import type { Opening } from "../../features/sweep/table";

export interface RangeDraft {
  readonly field: SweepField;
  /** Where the range comes from. */
  readonly why: string;
  readonly on: boolean;
  readonly from: string;
  readonly to: string;
}

export interface StudyDraft {
  readonly ranges: readonly RangeDraft[];
  readonly samples: string;
  readonly seed: string;
  readonly strategies: readonly StrategyId[];
  /** Each field alone at both its ends as well. */
  readonly oneByOne: boolean;
}

interface Sweeps {
  readonly cube: Sweep;
  /** The scenario itself, then each field alone at its low and its high end; `null` where it is not wanted. */
  readonly oneByOne: Sweep | null;
}

/** The study as the server proposes it; `made` is one that exists and is to be changed. */
export function draftStudy(defaults: RobustnessDefaults, form: Group, existing?: Batch): StudyDraft {
  const fields = sweepFields(form);
  const cube = existing?.sweep.latin_hypercube;
  const proposed = defaults.ranges.map(({ field, low, high, why }) => ({
    name: field,
    why,
    ends: cube ? cube.ranges[field] : [low, high],
    usual: [low, high],
  }));
  const others = Object.entries(cube?.ranges ?? {})
    .filter(([name]) => !proposed.some((each) => each.name === name))
    .map(([name, ends]) => ({ name, why: "", ends, usual: ends }));
  return {
    ranges: [...proposed, ...others].flatMap(({ name, why, ends, usual }): readonly RangeDraft[] => {
      const field = fields.find((each) => each.name === name);
      const [low, high] = ends ?? usual;
      if (field?.leaf.kind !== "number" || low === undefined || high === undefined) return [];
      const { leaf } = field;
      return [{ field, why, on: ends !== undefined, from: typedText(leaf, low), to: typedText(leaf, high) }];
    }),
    samples: String(cube?.samples ?? defaults.samples),
    seed: String(cube?.seed ?? 0),
    strategies: existing?.strategies ?? defaults.strategies,
    oneByOne: true,
  };
}

/** A stored draft of the study that opens as `opening`. */
export function restoreStudy(stored: unknown, opening: StudyDraft): StudyDraft | null {
  const range = { field: { name: "" }, on: true, from: "", to: "" };
  if (!isLike({ ranges: [range], samples: "", seed: "", strategies: [""], oneByOne: true }, stored)) return null;
  const { samples, seed, strategies, oneByOne } = stored;
  const ranges = opening.ranges.map((each) => {
    const texts = stored.ranges.find(({ field }) => field.name === each.field.name);
    return texts ? { ...each, on: texts.on, from: texts.from, to: texts.to } : each;
  });
  return { ranges, samples, seed, strategies, oneByOne };
}

/** What is sent, or what has to be changed first. */
export function readStudy({ ranges, samples, seed, strategies, oneByOne }: StudyDraft): Parsed<Sweeps> {
  const varied = ranges.filter(({ on }) => on);
  const fields = varied.map(({ field, from, to }) => ({ ...draftField(field), from, to }));
  const parsed = readDraft({ method: "hypercube", fields, samples, seed, strategies });
  if (!parsed.ok) {
    const none = fields.length === 0 && { fields: "Nothing is uncertain: switch on at least one field" };
    return { ok: false, errors: { ...parsed.errors, ...none } };
  }
  if (Number(samples) < LEAST_SAMPLES)
    return { ok: false, errors: { samples: `Samples: at least ${LEAST_SAMPLES}, for quantiles to mean anything` } };
  return { ok: true, body: { cube: parsed.body, oneByOne: oneByOne ? alone(parsed.body) : null } };
}

const LEAST_SAMPLES = 20;

export const hasOrder = (name: string) => !name.endsWith("seed");

function alone({ latin_hypercube: cube }: Sweep): Sweep | null {
  const ends = Object.entries(cube?.ranges ?? {}).filter(([name]) => hasOrder(name));
  if (ends.length === 0) return null;
  const points = ends.flatMap(([name, range]) => range.map((end) => ({ [name]: end })));
  return { list: [{}, ...points] };
}

/** What a field is where it is not varied: its value in the scenario, or that it is off. */
export function exactText({ leaf }: SweepField, scenario: Scenario | undefined): string {
  const value = scenario && getAt(scenario, leaf.pointer);
  if (value === null) return leaf.title === "Saturation" ? "exact: the force limit" : "exact: ideal";
  if (leaf.pointer.startsWith("/mismatch/") && value === leaf.paperValue) return "exact";
  return typeof value === "number" && leaf.kind === "number" ? `always ${valueText(leaf, value)}` : "exact";
}

export type StrategySummary = BatchSummary["strategies"][string];
export type FigureSummary = StrategySummary["figures"][string];
export type Margin = NonNullable<FigureSummary["margin"]>;
export type ExtremeRun = NonNullable<FigureSummary["highest"]>;
export type Sensitivity = FigureSummary["sensitivity"][number];

export const TRAVEL = "events.travel_exceeded_mm";
export const AIRBORNE = "events.airborne_ms";

const REFRESH_MS = 5_000;

export const summaryQuery = (batch: Batch, figures: readonly string[], baseline: StrategyId | null) =>
  queryOptions({
    // A summary of the final state is another one than those before it.
    queryKey: ["batch summary", batch.id, isFinal(batch), figures, baseline],
    queryFn: ({ signal }) =>
      ask(
        "get",
        "/batches/{id}/summary",
        { path: { id: batch.id }, query: { figures: figures.join(","), baseline } },
        signal,
      ),
    enabled: batch.done > 0 || isFinal(batch),
    staleTime: Infinity,
    gcTime: 5 * 60_000,
    placeholderData: keepPreviousData,
    refetchInterval: !isFinal(batch) && REFRESH_MS,
  });

/** The value at that percentage; `null` where there is none. */
export function quantile(
  summary: Pick<BatchSummary, "quantiles">,
  { quantiles }: Pick<FigureSummary, "quantiles">,
  percent: number,
): number | null {
  return quantiles?.[summary.quantiles.indexOf(percent)] ?? null;
}

/** What chance makes more often than this is not shown: a table has about a hundred of them. */
const CHANCE = 0.001;

export const matters = ({ p_value: chance }: Sensitivity) => chance < CHANCE;

export interface Ranked {
  readonly field: string;
  /** By figure. */
  readonly cells: Readonly<Record<string, Sensitivity>>;
  readonly most: number;
}

/** Fields by what they explain of whichever figure follows them most. */
export function ranked(sensitivities: Readonly<Record<string, readonly Sensitivity[]>>): readonly Ranked[] {
  const names = [...new Set(Object.values(sensitivities).flatMap((list) => list.map(({ field }) => field)))];
  return names
    .map((field): Ranked => {
      const cells = Object.fromEntries(
        Object.entries(sensitivities).flatMap(([figure, list]) =>
          list.filter((each) => each.field === field).map((each) => [figure, each] as const),
        ),
      );
      return { field, cells, most: Math.max(...Object.values(cells).map(({ effect }) => effect)) };
    })
    .sort((a, b) => b.most - a.most);
}

/** What a study's page gives its cards. */
export interface StudyParts {
  readonly batch: Batch;
  readonly summary: BatchSummary;
  /** The study's, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Metric[];
  readonly opening: Opening;
}
