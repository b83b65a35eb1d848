// @vitest-environment happy-dom
import { QueryClientProvider, QueryObserver } from "@tanstack/react-query";
import { createMemoryHistory, createRootRoute, createRouter, RouterContextProvider } from "@tanstack/react-router";
import { cleanup, renderHook } from "@testing-library/react";
import { createElement, type ReactNode } from "react";
import { afterEach, expect, it, vi } from "vitest";
import type { Batch, Tuning, TuningItem } from "../api/types";
import { createQueryClient } from "../server/queries";
import { BATCH, followJob, jobQuery, TUNING, useJob, type JobKind } from "./useJob";

/** A stream whose events come when a test says so. */
class Stream extends EventTarget {
  static newest: Stream | null = null;
  readonly readyState = 1;
  close = () => undefined;
  constructor() {
    super();
    Stream.newest = this;
  }
  say(number: number) {
    const data = JSON.stringify({ state: "running", done: 10 * number, failed: 0, total: 1000 });
    this.dispatchEvent(new MessageEvent("progress", { data, lastEventId: String(number) }));
  }
}

afterEach(() => {
  cleanup();
  vi.unstubAllGlobals();
});

it("A running tuning whose past events come all at once is asked for once at a time, and once more for the newest", async () => {
  vi.stubGlobal("EventSource", Stream);
  const queries = createQueryClient();
  const asked: { readonly answer: () => void; readonly signal: AbortSignal | undefined }[] = [];
  const get = (id: string, signal?: AbortSignal) =>
    new Promise<Tuning>((resolve) => {
      const done = 10 * asked.length;
      asked.push({ answer: () => resolve({ id, state: "running", trials: { done } } as unknown as Tuning), signal });
    });
  const kind: JobKind<TuningItem, Tuning> = { ...TUNING, calls: { ...TUNING.calls, get } };
  const observer = new QueryObserver(queries, jobQuery(kind, "T"));
  const leave = observer.subscribe(() => undefined);
  asked[0]?.answer();
  await vi.waitFor(() => expect(observer.getCurrentResult().data).toBeDefined(), 60_000);

  const stop = followJob(kind, "T", queries, { onConnected: () => undefined, onEvent: () => undefined });
  for (let number = 1; number <= 60; number++) Stream.newest?.say(number);
  expect(asked).toHaveLength(2);
  asked[1]?.answer();
  await vi.waitFor(() => expect(asked).toHaveLength(3), 60_000);
  asked[2]?.answer();
  await vi.waitFor(() => expect(observer.getCurrentResult().data?.trials.done).toBe(20), 60_000);
  expect(asked).toHaveLength(3);
  expect(asked.map(({ signal }) => signal?.aborted)).toEqual([false, false, false]);
  stop();
  leave();
  queries.clear();
});

it("A job that came with a link is there without being asked for", () => {
  const fetch = vi.fn(() => Promise.reject(new TypeError("no connection")));
  vi.stubGlobal("fetch", fetch);
  const client = createQueryClient();
  const router = createRouter({ routeTree: createRootRoute(), history: createMemoryHistory() });
  const batch = { id: "B", state: "done" } as unknown as Batch;
  const { result } = renderHook(() => useJob(BATCH, "B", batch), {
    wrapper: ({ children }: { readonly children: ReactNode }) =>
      createElement(
        RouterContextProvider,
        { router } as never,
        createElement(QueryClientProvider, { client }, children),
      ),
  });
  expect(result.current.job).toBe(batch);
  expect(fetch).not.toHaveBeenCalled();
  client.clear();
});
