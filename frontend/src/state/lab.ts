/** The page's one controller: what is edited, what is asked of the server, and what is shown. */

import type { QueryClient } from "@tanstack/react-query";
import { api } from "../api/client";
import { ApiProblem, isAbort, isNotFound, isTransient } from "../api/problem";
import type { LiveAnswer, Run, Scenario, StrategyId } from "../api/types";
import { placeErrors, type PlacedErrors } from "../editor/errors";
import { sameValue } from "../editor/path";
import type { Group } from "../editor/schema";
import { cursor } from "./cursor";
import { historiesOf } from "./histories";
import { begin, record, redo, undo, type History } from "./history";
import type { Lab, LabState } from "./labState";
import { createLatest } from "./latest";
import { linkQuery, runKey } from "./queries";
import type { Router } from "./router";
import { fromLive, fromRun } from "./shown";
import { axisKey } from "./scene";
import { readSharedView } from "./sharing";
import { createStore } from "./store";
import { createTimer } from "./timer";

const NO_ERRORS: PlacedErrors = { fields: {}, general: [] };
const STALE_AFTER_MS = 200;
const LIVE_POINTS = 700;
const LIVE_POINTS_MOST = 5000;

/** One exact request. */
interface Exact {
  readonly work: (signal: AbortSignal, isCurrent: () => boolean) => Promise<void>;
  /** Asks for the same once more. */
  readonly again: () => void;
  /** What else to do where it fails for good. */
  readonly giveUp?: () => void;
}

const hasErrors = ({ fields, general }: PlacedErrors) => general.length > 0 || Object.keys(fields).length > 0;

const OPENING_STRATEGIES: readonly StrategyId[] = ["lv", "lqr", "passive"];

export function createLab(router: Router, queries: QueryClient): Lab {
  const store = createStore<LabState>({
    history: null,
    drag: null,
    rejected: {},
    refused: NO_ERRORS,
    strategies: OPENING_STRATEGIES,
    roads: 1,
    shown: null,
    shared: null,
    busy: false,
    stale: false,
    failure: null,
  });
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));
  const grace = createTimer(STALE_AFTER_MS, () => patch({ stale: true }));

  let form: Group | null = null;
  let signals: readonly string[] = [];
  let current: AbortController | null = null;
  let unfinished: (() => void) | null = null;

  const refuse = (problem: ApiProblem) => {
    if (problem.status === 422 && form) patch({ refused: placeErrors(form, problem.errors, problem.message) });
    else patch({ failure: { kind: "failed", message: problem.message } });
  };

  const fail = (error: unknown, again: () => void) => {
    if (isAbort(error)) return;
    if (isTransient(error)) {
      unfinished = again;
      patch({ failure: { kind: "unreachable" } });
    } else if (isNotFound(error)) patch({ failure: { kind: "notFound" } });
    else if (error instanceof ApiProblem) refuse(error);
    else patch({ failure: { kind: "failed", message: error instanceof Error ? error.message : "Something went wrong" } });
  };

  /** Runs one exact request; whatever ran before is aborted, so a stale answer never lands. */
  const exclusively = ({ work, again, giveUp }: Exact) => {
    live.cancel();
    current?.abort();
    const controller = new AbortController();
    current = controller;
    unfinished = null;
    const isCurrent = () => current === controller;
    patch({ busy: true, failure: null, refused: NO_ERRORS });
    grace.start();
    work(controller.signal, isCurrent)
      .catch((error: unknown) => {
        if (!isCurrent()) return;
        if (!isAbort(error) && !isTransient(error)) giveUp?.();
        fail(error, again);
      })
      .finally(() => {
        if (!isCurrent()) return;
        grace.stop();
        // After a failure the old curves stay dimmed: they are not what the form says.
        patch({ busy: false, stale: store.get().failure !== null || hasErrors(store.get().refused) });
      });
  };

  // Each of the three below changes address, form, table and curves in one turn, once it has all of them: nobody sees,
  // shares or goes back to an address that is not of what is shown.

  const submit = (mode: "push" | "replace") => {
    const { history, strategies, roads } = store.get();
    if (strategies.length === 0) return;
    const { baseline } = router.get().view;
    const over = roads > 1 ? { roads, ...(strategies.includes(baseline) ? { baseline } : {}) } : null;
    exclusively({
      work: async (signal, isCurrent) => {
        const startedAt = performance.now();
        const run = await api.createRun(history?.present ?? {}, strategies, signal, over);
        if (!isCurrent()) return;
        queries.setQueryData(runKey(run.id), run);
        if (history === null) patch({ history: begin(run.scenario) });
        const histories = await historiesOf(run, queries);
        if (!isCurrent()) return;
        const selected = store.get().strategies;
        const hidden = Object.keys(run.strategies).filter((strategy) => !selected.includes(strategy));
        router.showRun(run.id, { hidden }, mode);
        patch({ shown: fromRun(run, histories, performance.now() - startedAt, false), drag: null, shared: null });
      },
      again: () => submit(mode),
    });
  };

  const load = (id: string, hidden: readonly StrategyId[]) => {
    exclusively({
      work: async (signal, isCurrent) => {
        const startedAt = performance.now();
        const cached = queries.getQueryData<Run>(runKey(id));
        const run = cached ?? (await api.run(id, signal));
        if (!isCurrent()) return;
        queries.setQueryData(runKey(id), run);
        const histories = await historiesOf(run, queries);
        if (!isCurrent()) return;
        const { history } = store.get();
        router.arrive();
        if (run.over) router.setView({ baseline: run.over.baseline });
        patch({
          roads: run.over?.roads ?? 1,
          history: history ? record(history, run.scenario) : begin(run.scenario),
          strategies: Object.keys(run.strategies).filter((strategy) => !hidden.includes(strategy)),
          rejected: {},
          drag: null,
          shared: null,
          shown: fromRun(run, histories, performance.now() - startedAt, true),
        });
      },
      again: () => load(id, hidden),
      giveUp: leaveLink,
    });
  };

  const openLink = (slug: string) => {
    exclusively({
      work: async (signal, isCurrent) => {
        const startedAt = performance.now();
        const link = await queries.query(linkQuery(slug));
        if (signal.aborted || !isCurrent()) return;
        if (!link.run && !link.batch) throw new Error("There is nothing behind this link that this page can show");
        const histories = link.run && (await historiesOf(link.run, queries));
        if (!isCurrent()) return;
        const { view, strategies, at } = readSharedView(link);
        router.arrive();
        router.setView(view);
        cursor.set(at);
        const shown = link.run && histories ? fromRun(link.run, histories, performance.now() - startedAt, true) : null;
        patch({ shared: link, history: begin(link.scenario), strategies, roads: link.run?.over?.roads ?? 1, rejected: {}, drag: null, shown });
      },
      again: () => openLink(slug),
      giveUp: leaveLink,
    });
  };

  /** The address has nothing to show: neither is anything else shown under it. */
  const leaveLink = () => {
    router.arrive();
    patch({ shared: null });
  };

  /** Zoomed in, the same density of samples takes more of them over the whole run. */
  const livePoints = () => {
    const { zoom, axis } = router.get().view;
    const longest = Object.values(store.get().shown?.series ?? {}).map((series) => series[axisKey(axis)]?.at(-1) ?? 0);
    const part = zoom ? (zoom[1] - zoom[0]) / Math.max(1e-9, ...longest) : 1;
    return Math.round(Math.min(LIVE_POINTS_MOST, LIVE_POINTS / Math.max(part, 0.01)));
  };

  interface Wish {
    readonly scenario: Scenario;
    readonly startedAt: number;
  }

  const live = createLatest<Wish, LiveAnswer>({
    run: ({ scenario }, signal) => {
      grace.start();
      return api.live({ scenario, strategies: store.get().strategies, signals, points: livePoints() }, signal);
    },
    onAnswer: (answer, { scenario, startedAt }) => {
      grace.stop();
      const settled = store.get().drag === scenario;
      const shown = fromLive(answer, performance.now() - startedAt);
      patch({ shown, refused: NO_ERRORS, failure: null, ...(settled ? { busy: false, stale: false } : {}) });
    },
    onError: (error) => {
      // While dragging, an overloaded or silent server only means no new curves; the release asks again.
      grace.stop();
      if (error instanceof ApiProblem && !isTransient(error)) refuse(error);
      patch({ busy: false, stale: true });
    },
  });

  const move = (step: (history: History<Scenario>) => History<Scenario>) => {
    const { history, shared } = store.get();
    if (!history || shared) return;
    const next = step(history);
    if (next === history) return;
    patch({ history: next, rejected: {}, drag: null });
    submit("push");
  };

  const open: Lab["open"] = ({ runId, slug, view }) => {
    if (slug !== null) openLink(slug);
    else if (runId !== null) load(runId, view.hidden);
    else submit("replace");
  };

  return {
    get: store.get,
    subscribe: store.subscribe,
    open,
    travel: (address) => {
      open(address);
      // The browser has changed the address already: that what is shown is not of it is said at once.
      patch({ stale: true });
    },
    openPaper: () => {
      patch({ history: null, rejected: {}, strategies: OPENING_STRATEGIES, roads: 1, shown: null, shared: null });
      submit("push");
    },
    openCopy: () => {
      if (store.get().shared) submit("push");
    },
    configure: (nextForm, nextSignals) => {
      form = nextForm;
      signals = nextSignals;
    },
    drag: (scenario) => {
      if (store.get().shared) return;
      current?.abort();
      current = null;
      const { strategies } = store.get();
      patch({ drag: scenario, busy: strategies.length > 0 });
      if (strategies.length > 0) live.request({ scenario, startedAt: performance.now() });
    },
    commit: (scenario) => {
      const { history, shared } = store.get();
      if (shared) return;
      const same = history?.present === scenario;
      if (!same) patch({ history: history ? record(history, scenario) : begin(scenario) });
      patch({ drag: null });
      submit("push");
    },
    reject: (pointer, rejected) => patch({ rejected: { ...store.get().rejected, [pointer]: rejected } }),
    accept: (pointer) => {
      const { [pointer]: removed, ...rejected } = store.get().rejected;
      if (removed) patch({ rejected });
    },
    undo: () => move(undo),
    redo: () => move(redo),
    setStrategies: (ids) => {
      const { shown, history, shared } = store.get();
      const computed = shown?.source === "exact" ? Object.keys(shown.summaries) : [];
      const strategies = shared ? ids.filter((strategy) => computed.includes(strategy)) : ids;
      patch({ strategies });
      const cached = strategies.every((strategy) => computed.includes(strategy));
      if (shared || (cached && history && shown && sameValue(shown.scenario, history.present))) {
        router.setView({ hidden: computed.filter((strategy) => !strategies.includes(strategy)) });
      } else submit("push");
    },
    setRoads: (roads) => {
      if (store.get().shared) return;
      patch({ roads });
      submit("push");
    },
    setBaseline: (baseline) => {
      const { shown, shared } = store.get();
      router.setView({ baseline });
      if (!shared && shown?.over && shown.over.baseline !== baseline) submit("push");
    },
    resume: () => unfinished?.(),
  };
}
