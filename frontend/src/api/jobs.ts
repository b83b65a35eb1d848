/** Batches and tunings: the calls that all jobs have, and each kind's own. */

import { asQuery, BASE, get, patch, post, remove } from "./http";
import type {
  Batch,
  BatchItem,
  BatchSummary,
  BatchTable,
  Estimate,
  RobustnessDefaults,
  Scenario,
  StrategyId,
  Sweep,
  Trial,
  Tuning,
  TuningEstimate,
  TuningItem,
} from "./types";

export interface SweepRequest {
  readonly scenario: Scenario;
  readonly strategies: readonly StrategyId[];
  readonly sweep: Sweep;
  readonly label?: string;
}

/** What of a tuning is chosen beside its scenario. */
export interface TuningChoice {
  readonly strategy: StrategyId;
  readonly objectives: readonly Readonly<Record<string, unknown>>[];
  readonly limits: readonly { readonly figure: string; readonly at_most: number }[];
  readonly search: Readonly<Record<string, readonly [number, number]>>;
  readonly previews?: readonly string[];
  readonly uncertain?: true;
  readonly quantile?: number;
  readonly seeds: readonly number[];
  readonly fresh_seeds: readonly number[];
  readonly trials: number;
  readonly population: number;
  readonly seed: number;
}

export interface TuningRequest extends TuningChoice {
  readonly scenario: Scenario;
}

export interface JobPage<Item> {
  readonly items: readonly Item[];
  /** The next page's cursor. */
  readonly next: string | null;
}

const PAGE = "10";
/** What is sent again with its key begins nothing anew. */
const withKey = (key: string) => ({ headers: { "idempotency-key": key } });

function callsOf<Item, Job extends Item>(plural: "batches" | "tunings") {
  const path = (id: string, rest = "") => `/${plural}/${encodeURIComponent(id)}${rest}`;
  return {
    /** The newest first. */
    page: async (cursor: string | null, label?: string, signal?: AbortSignal): Promise<JobPage<Item>> => {
      const query = asQuery({ limit: PAGE, ...(cursor !== null && { cursor }), ...(label !== undefined && { label }) });
      const answer = await get<Partial<Record<typeof plural, readonly Item[]>> & Pick<JobPage<Item>, "next">>(`/${plural}${query}`, signal);
      return { items: answer[plural] ?? [], next: answer.next };
    },
    get: (id: string, signal?: AbortSignal) => get<Job>(path(id), signal),
    cancel: (id: string) => post<Job>(path(id, "/cancel"), {}),
    resume: (id: string, query: Readonly<Record<string, string>> = {}) => post<Job>(path(id, `/resume${asQuery(query)}`), {}),
    label: (id: string, label: string | null) => patch<Job>(path(id), { label }),
    delete: (id: string) => remove(path(id)),
    eventsAddress: (id: string, after: number) => BASE + path(id, `/events?after=${after}`),
    path,
  };
}

export type JobCalls<Item, Job extends Item> = ReturnType<typeof callsOf<Item, Job>>;

const ofBatches = callsOf<BatchItem, Batch>("batches");

export const batches = {
  ...ofBatches,
  create: (body: SweepRequest, key: string) => post<Batch>("/batches", body, withKey(key)),
  estimate: (body: SweepRequest, signal?: AbortSignal) => post<Estimate>("/batches", { ...body, dry_run: true }, { signal }),
  table: (id: string, figures: readonly string[], signal?: AbortSignal) =>
    get<BatchTable>(ofBatches.path(id, `/table${asQuery({ figures: figures.join(",") })}`), signal),
  summary: (id: string, figures: readonly string[], baseline: StrategyId | null, signal?: AbortSignal) =>
    get<BatchSummary>(ofBatches.path(id, `/summary${asQuery({ figures: figures.join(","), ...(baseline !== null && { baseline }) })}`), signal),
  robustness: (signal?: AbortSignal) => get<RobustnessDefaults>("/robustness", signal),
  resultsAddress: (id: string, format: "json" | "csv" | "parquet") => BASE + ofBatches.path(id, `/results?format=${format}`),
};

const ofTunings = callsOf<TuningItem, Tuning>("tunings");

export const tunings = {
  ...ofTunings,
  create: (body: TuningRequest, key: string) => post<Tuning>("/tunings", body, withKey(key)),
  estimate: (body: TuningRequest, signal?: AbortSignal) => post<TuningEstimate>("/tunings", { ...body, dry_run: true }, { signal }),
  trials: (id: string, signal?: AbortSignal) => get<{ readonly trials: readonly Trial[] }>(ofTunings.path(id, "/trials"), signal),
};
