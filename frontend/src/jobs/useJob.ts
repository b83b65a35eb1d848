/** A job as it stands: read once, then kept up to date by its events. */

import { queryOptions, useMutation, useQueryClient, useSuspenseQuery, type QueryClient } from "@tanstack/react-query";
import { useEffect, useState } from "react";
import { batches, tunings, type JobCalls } from "../api/jobs";
import type { Batch, BatchItem, Tuning, TuningItem } from "../api/types";
import { isNotFound } from "../api/problem";
import { isLike } from "../lib/storage";
import { createLatest } from "../lib/latest";
import { RETRIED } from "../server/queries";
import { useRouter } from "@tanstack/react-router";

export type Common = Pick<Batch, "id" | "state" | "reason" | "label" | "position" | "created_at">;

/** A page that shows one job. */
export type JobPath = "/b/$id" | "/tuner/$id" | "/robustness/$id";

/** What a list shows of a job and what its own page has of it differ; what all have in common is `Common`. */
export interface JobKind<Item extends Common, Job extends Item> {
  readonly name: "batch" | "tuning";
  /** What is counted. */
  readonly unit: "run" | "trial";
  readonly calls: JobCalls<Item, Job>;
  readonly page: JobPath;
  readonly counts: (job: Item) => Pick<JobEvent, "done" | "failed" | "total">;
  /** The job with an event's news; null where the job itself has to be asked for. */
  readonly withEvent: (job: Job, event: JobEvent) => Job | null;
}

export const BATCH: JobKind<BatchItem, Batch> = {
  name: "batch",
  unit: "run",
  calls: batches,
  page: "/b/$id",
  counts: (batch) => batch,
  withEvent: (batch, event) => {
    // When it ended, and why, no event says, nor what planning found.
    if (isFinal(event) || batch.state === "planning") return null;
    // The first events are of the past.
    return event.done + event.failed < batch.done + batch.failed ? batch : { ...batch, ...event };
  },
};

export const TUNING: JobKind<TuningItem, Tuning> = {
  name: "tuning",
  unit: "trial",
  calls: tunings,
  page: "/tuner/$id",
  counts: ({ trials }) => trials,
  withEvent: () => null,
};

export const jobQuery = <Item extends Common, Job extends Item>({ name, calls }: JobKind<Item, Job>, id: string) =>
  queryOptions({
    queryKey: [name, id],
    queryFn: ({ signal }) => calls.get(id, signal),
    staleTime: Infinity,
    ...RETRIED,
  });

const REPLAY_MS = 1_000;
/** No event says how many runs are still before it. */
const QUEUED_MS = 3_000;

export interface JobStatus<Job> {
  readonly job: Job;
  readonly connected: boolean;
  /** Seconds, `null` while unknown. */
  readonly left: number | null;
}

/**
 * Keeps the stored job up to date by its events, until the returned function is called.
 *
 * The job is asked for once at a time: of events that come meanwhile only the newest asks again.
 */
export function followJob<Item extends Common, Job extends Item>(
  kind: JobKind<Item, Job>,
  id: string,
  queries: QueryClient,
  handlers: Handlers,
): () => void {
  const { queryKey } = jobQuery(kind, id);
  const asking = createLatest({
    run: () => queries.invalidateQueries({ queryKey }),
    onAnswer: () => undefined,
    onError: () => undefined,
  });
  const stop = follow((after) => kind.calls.eventsAddress(id, after), {
    ...handlers,
    onEvent: (event) => {
      handlers.onEvent(event);
      const before = queries.getQueryData<Job>(queryKey);
      const now = before ? kind.withEvent(before, event) : null;
      if (now) queries.setQueryData<Job>(queryKey, now);
      else asking.request(undefined);
    },
  });
  return () => {
    stop();
    asking.cancel();
  };
}

/** The page's route has fetched it, or it came with a link. */
export function useJob<Item extends Common, Job extends Item>(
  kind: JobKind<Item, Job>,
  id: string,
  fromLink?: Job,
): JobStatus<Job> {
  const queries = useQueryClient();
  const { data: job, error } = useSuspenseQuery({
    ...jobQuery(kind, id),
    ...(fromLink && { initialData: fromLink }),
    refetchInterval: ({ state: { data } }) => data?.state === "queued" && data.position > 0 && QUEUED_MS,
  });
  // It has been deleted since: the route says so.
  const router = useRouter();
  useEffect(() => {
    if (isNotFound(error)) void router.invalidate();
  }, [error, router]);
  const [connected, setConnected] = useState(true);
  const [marks, setMarks] = useState<readonly Mark[]>([]);
  const unfinished = !isFinal(job);

  useEffect(() => {
    if (!unfinished) return undefined;
    const opened = performance.now();
    return followJob(kind, id, queries, {
      onConnected: setConnected,
      onEvent: (event) => {
        const mark = { at: performance.now(), finished: event.done + event.failed };
        // Events of the past come all at once and say nothing of the pace.
        setMarks((all) => (mark.at - opened < REPLAY_MS ? [mark] : withMark(all, mark)));
      },
    });
  }, [kind, id, unfinished, queries]);

  return { job, connected, left: job.state === "running" ? secondsLeft(marks, kind.counts(job).total) : null };
}

/** A call that answers with the job as it is then. */
export function useJobCall<Item extends Common, Job extends Item, Value = undefined>(
  kind: JobKind<Item, Job>,
  id: string,
  call: (value: Value) => Promise<Job>,
) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: call,
    onSuccess: (now) => queries.setQueryData<Job>([kind.name, id], now),
  });
}

/** How long a batch will still take, by how fast it went lately. */
export interface Mark {
  /** [ms] on any clock that does not jump. */
  readonly at: number;
  /** Runs finished by then. */
  readonly finished: number;
}

/** Long enough to even out chunks of about a second, short enough to follow a change of pace [ms]. */
const WINDOW_MS = 20_000;
const LEAST_MS = 1_500;

/** The marks with a new one, without those too old to tell of the pace; one older than the window stays as its start. */
export function withMark(marks: readonly Mark[], mark: Mark): readonly Mark[] {
  const all = [...marks, mark];
  const start = all.findLastIndex(({ at }) => at <= mark.at - WINDOW_MS);
  return all.slice(Math.max(0, start));
}

/** Seconds left, `null` while nobody can know. */
export function secondsLeft(marks: readonly Mark[], total: number): number | null {
  const [first, last] = [marks[0], marks.at(-1)];
  if (!first || !last || last.at - first.at < LEAST_MS || last.finished <= first.finished) return null;
  return ((total - last.finished) * (last.at - first.at)) / (last.finished - first.finished) / 1000;
}

/** What every event says. */
type JobEvent = Pick<Batch, "state" | "done" | "failed" | "total">;

const FINAL: readonly Batch["state"][] = ["done", "cancelled", "failed"];
export const isFinal = ({ state }: Pick<Batch, "state">) => FINAL.includes(state);

const EVENTS = ["state", "progress", "restart"];
const RETRY_MS = 3000;

const EVENT: JobEvent = { state: "queued", done: 0, failed: 0, total: 0 };

function read(text: string): JobEvent | null {
  try {
    const value: unknown = JSON.parse(text, (key, part: unknown) => (key === "total" ? (part ?? 0) : part));
    return isLike(EVENT, value) ? value : null;
  } catch {
    return null;
  }
}

interface Handlers {
  readonly onEvent: (event: JobEvent) => void;
  /** Whether events can arrive at the moment. */
  readonly onConnected: (connected: boolean) => void;
}

/**
 * From the first event on, until the returned function is called: the events of a resumed job go on behind a final
 * state. The browser itself asks again from where a connection broke; only where the server refuses it has to be asked
 * anew, from the last number seen.
 */
function follow(address: (after: number) => string, { onEvent, onConnected }: Handlers): () => void {
  let source: EventSource | null = null;
  let retry: ReturnType<typeof setTimeout> | undefined;
  let [lastEvent, ended] = [0, false];

  const receive = ({ data, lastEventId }: MessageEvent<string>) => {
    lastEvent = Number(lastEventId) || lastEvent;
    const event = read(data);
    if (event === null) return;
    ended = isFinal(event);
    onEvent(event);
  };
  const connect = () => {
    const opened = new EventSource(address(lastEvent));
    source = opened;
    opened.addEventListener("open", () => onConnected(true));
    for (const name of EVENTS) opened.addEventListener(name, receive);
    opened.addEventListener("error", () => {
      // Behind a final state the server itself ends the stream.
      if (!ended) onConnected(false);
      if (opened.readyState === EventSource.CLOSED) retry = setTimeout(connect, RETRY_MS);
    });
  };
  connect();
  return () => {
    clearTimeout(retry);
    source?.close();
  };
}
