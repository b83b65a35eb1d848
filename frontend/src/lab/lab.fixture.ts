/** A lab before a server whose answers come when a test says so. */

import { QueryClient } from "@tanstack/react-query";
import type { LiveAnswer, LiveRequest, Run, Scenario, SeriesByStrategy, StrategyId, Summary } from "../api/types";
import { DEFAULT_VIEW, type Address } from "./address";
import type { LabApi } from "./labState";
import { createLab } from "./lab";
import type { LabAddress } from "./labAddress";
import { createAtom } from "@tanstack/react-store";

export const PAPER: Scenario = { height: 0.1 };
export const LOW: Scenario = { height: 0.06 };
export const OPENING = ["lv", "lqr", "passive"];

const summary = {
  ...{ status: "ok", compute_ms: 1, cached: false },
  ...{ metrics: {}, comfort: {}, events: {}, stages: [] },
} as unknown as Summary;
const byStrategy = <T>(ids: readonly StrategyId[], value: T) => Object.fromEntries(ids.map((id) => [id, value]));
export const idOf = (scenario: Scenario, ids: readonly StrategyId[], roads = 1) =>
  [JSON.stringify(scenario), ...ids, ...(roads > 1 ? [roads] : [])].join(" ");

function runOf(scenario: Scenario, ids: readonly StrategyId[], roads = 1): Run {
  const over = roads > 1 ? { roads, baseline: "passive", changes: {}, estimates: {} } : null;
  const verdict = { text: "", best: {}, mixed: false };
  const changes = { changes: {}, changes_against: {} };
  const comparison = { baseline: "passive", ...changes, verdict, cautions: [], requirements: [] };
  const strategies = byStrategy(ids, summary);
  return { id: idOf(scenario, ids, roads), core_version: "1", scenario, comparison, strategies, over };
}

/** A labAddress without a browser. */
function fakeRouter() {
  const store = createAtom<Address>({ runId: null, slug: null, view: DEFAULT_VIEW });
  const labAddress: LabAddress = {
    get: store.get,
    subscribe: store.subscribe,
    showRun: (runId, view) => store.set(({ view: old }) => ({ runId, slug: null, view: { ...old, ...view } })),
    setView: (change) => store.set((address) => ({ ...address, view: { ...address.view, ...change } })),
    onNavigate: () => () => undefined,
    confirmNavigation: () => undefined,
    cancelNavigation: () => undefined,
    clearFrom: () => undefined,
  };
  return labAddress;
}

interface Held {
  readonly answer: () => void;
  readonly signal: AbortSignal | undefined;
}

/** A lab before a server whose answers come when a test says so. */
export function harness() {
  const held: Record<"runs" | "series" | "live", Held[]> = { runs: [], series: [], live: [] };
  const hold = <T>(kind: keyof typeof held, value: T, signal: AbortSignal | undefined) =>
    new Promise<T>((resolve, reject) => {
      signal?.addEventListener("abort", () => reject(new DOMException("aborted", "AbortError")));
      held[kind].push({ answer: () => resolve(value), signal });
    });
  const liveRequests: LiveRequest[] = [];
  const api: LabApi = {
    createRun: (scenario, ids, signal, over) =>
      hold("runs", runOf("height" in scenario ? scenario : PAPER, ids, over?.roads ?? 1), signal),
    run: (id, signal) => hold("runs", runOf(id === "low" ? LOW : PAPER, OPENING), signal),
    series: (_id, ids, _points, signal) => hold<SeriesByStrategy>("series", byStrategy(ids, {}), signal),
    link: () => Promise.reject(new Error("no link here")),
    live: (request, signal) => {
      const { scenario = {}, strategies } = request;
      liveRequests.push(request);
      return hold<LiveAnswer>(
        "live",
        {
          core_version: "1",
          scenario,
          characteristics: {} as NonNullable<LiveAnswer["characteristics"]>,
          strategies: byStrategy(strategies, { ...summary, cached: false }),
          series: byStrategy(strategies, {}),
        },
        signal,
      );
    },
  };
  const labAddress = fakeRouter();
  const lab = createLab({ api, labAddress, queries: new QueryClient() });
  const { setTimeout: later } = globalThis; // not a test's own
  const tick = () => new Promise((resolve) => later(resolve, 0));
  const answer = async (kind: keyof typeof held) => {
    held[kind].at(-1)?.answer();
    await tick();
  };
  /** The newest run and its curves are answered. */
  const respond = async () => {
    await answer("runs");
    await answer("series");
  };
  const agree = () => {
    const { shown, strategies } = lab.get();
    const { runId, view } = labAddress.get();
    return {
      run: shown?.runId === runId,
      strategies: Object.keys(shown?.summaries ?? {}).filter((id) => !view.hidden.includes(id)),
      selected: strategies,
    };
  };
  const start = async () => {
    lab.open(labAddress.get());
    await respond();
  };
  return { lab, labAddress, held, liveRequests, answer, respond, tick, agree, start };
}
