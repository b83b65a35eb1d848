/** Batches and tunings: the calls that all jobs have. */

import { address, ask } from "./http";
import type { Batch as BatchAnswer, BatchItem as BatchItemAnswer, Sweep } from "./schema.gen";
import type { Batch, BatchItem, Tuning, TuningItem } from "./types";

interface JobPage<Item> {
  readonly items: readonly Item[];
  /** The next page's cursor. */
  readonly next: string | null;
}

export interface JobCalls<Item, Job extends Item> {
  /** The newest first. */
  readonly page: (
    query: { readonly limit: number; readonly cursor: string | null; readonly label: string | null },
    signal: AbortSignal,
  ) => Promise<JobPage<Item>>;
  readonly get: (id: string, signal: AbortSignal) => Promise<Job>;
  readonly cancel: (id: string) => Promise<Job>;
  readonly label: (id: string, label: string | null) => Promise<Job>;
  readonly delete: (id: string) => Promise<void>;
  readonly eventsAddress: (id: string, after: number) => string;
}

/** What is sent again with its key begins nothing anew. */
export const withKey = (key: string) => ({ header: { "idempotency-key": key } });

const planned = <Answer extends BatchItemAnswer>(answer: Answer) => ({
  ...answer,
  total: answer.total ?? 0,
  fields: answer.fields ?? [],
});

/** By batch: a sweep never changes, and a batch is asked for often. */
const sweeps = new Map<string, Sweep>();

export async function readBatch(answer: BatchAnswer): Promise<Batch> {
  const { id } = answer;
  const sweep = sweeps.get(id) ?? (await ask("get", "/batches/{id}/sweep", { path: { id } }));
  sweeps.set(id, sweep);
  return { ...planned(answer), sweep };
}

export const batches: JobCalls<BatchItem, Batch> = {
  page: async (query, signal) => {
    const { batches: items, next } = await ask("get", "/batches", { query }, signal);
    return { items: items.map(planned), next };
  },
  get: async (id, signal) => readBatch(await ask("get", "/batches/{id}", { path: { id } }, signal)),
  cancel: async (id) => readBatch(await ask("post", "/batches/{id}/cancel", { path: { id } })),
  label: async (id, label) => readBatch(await ask("patch", "/batches/{id}", { path: { id }, body: { label } })),
  delete: (id) => ask("delete", "/batches/{id}", { path: { id } }),
  eventsAddress: (id, after) => address("/batches/{id}/events", { path: { id }, query: { after } }),
};
export const resumeBatch = async (id: string) => readBatch(await ask("post", "/batches/{id}/resume", { path: { id } }));

export const tunings: JobCalls<TuningItem, Tuning> = {
  page: async (query, signal) => {
    const { tunings: items, next } = await ask("get", "/tunings", { query }, signal);
    return { items, next };
  },
  get: (id, signal) => ask("get", "/tunings/{id}", { path: { id } }, signal),
  cancel: (id) => ask("post", "/tunings/{id}/cancel", { path: { id } }),
  label: (id, label) => ask("patch", "/tunings/{id}", { path: { id }, body: { label } }),
  delete: (id) => ask("delete", "/tunings/{id}", { path: { id } }),
  eventsAddress: (id, after) => address("/tunings/{id}/events", { path: { id }, query: { after } }),
};
