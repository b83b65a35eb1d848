/** A robustness study while somebody puts it together, and the batches that come of it. */

import type { Batch, RobustnessDefaults, Scenario, StrategyId, Sweep } from "../../api/types";
import { typedText, valueText } from "../../scenario/limits";
import { getAt } from "../../scenario/path";
import type { Group } from "../../scenario/schema";
import { isLike } from "../../lib/storage";
import type { DraftErrors } from "../../features/jobForm/problems";
import { draftField, readDraft } from "../../features/sweep/draft";
import { sweepFields, type SweepField } from "../../scenario/fields";

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

export interface Sweeps {
  readonly cube: Sweep;
  /** The scenario itself, then each field alone at its low and its high end; `null` where it is not wanted. */
  readonly oneByOne: Sweep | null;
}

export type ParsedDraft =
  | { readonly ok: true; readonly sweeps: Sweeps }
  | { readonly ok: false; readonly errors: DraftErrors };

/** As it was sent: the server takes nothing else. */
export const sweepOf = ({ sweep }: Pick<Batch, "sweep">) => sweep as Sweep;

/** The study as the server proposes it; `made` is one that exists and is to be changed. */
export function draftStudy(defaults: RobustnessDefaults, form: Group, existing?: Batch): StudyDraft {
  const fields = sweepFields(form);
  const cube = existing && sweepOf(existing).latin_hypercube;
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
export function readStudy({ ranges, samples, seed, strategies, oneByOne }: StudyDraft): ParsedDraft {
  const varied = ranges.filter(({ on }) => on);
  const fields = varied.map(({ field, from, to }) => ({ ...draftField(field), from, to }));
  const parsed = readDraft({ method: "hypercube", fields, samples, seed, strategies });
  if (!parsed.ok) {
    const { fields: none, ...errors } = parsed.errors;
    return {
      ok: false,
      errors: {
        ...errors,
        ...(none === undefined ? {} : { fields: "Nothing is uncertain: switch on at least one field" }),
      },
    };
  }
  if (Number(samples) < LEAST_SAMPLES)
    return { ok: false, errors: { samples: `Samples: at least ${LEAST_SAMPLES}, for quantiles to mean anything` } };
  return { ok: true, sweeps: { cube: parsed.sweep, oneByOne: oneByOne ? alone(parsed.sweep) : null } };
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
