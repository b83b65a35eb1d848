/** What the lab asks of the server, and how an answer changes what is shown. */

import { isTransient, isAbort, ApiProblem } from "../api/problem";
import { type StrategyId, type LiveAnswer, type LiveRequest, type Scenario, type Strategy } from "../api/types";
import { DEFAULT_VIEW } from "./address";
import { cursor } from "./cursor";
import { historiesOf } from "./histories";
import { begin, record } from "./history";
import { type Lab, type LabState, type LabForm, type Services } from "./labState";
import { NO_ERRORS, problemOf, hasErrors, refusal } from "./problems";
import { fromCache, linkKey, runKey, ALL_POINTS, strategiesQuery } from "../server/queries";
import { readSharedView } from "./sharing";
import { fromRun, resultsAfterEdit, resultsAfterOpening, fromLive, type Result } from "./result";
import { type Atom, createAtom } from "@tanstack/react-store";
import { isRecording } from "../lib/recording";
import { createTimer, type Timer } from "../lib/timer";
import { withoutGone } from "../scenario/differences";
import { createLatest } from "../lib/latest";
import { axisKey, bumpRange } from "./resultView";
import { type QueryClient } from "@tanstack/react-query";

const STALE_AFTER_MS = 200;

export interface Requests extends Pick<Lab, "newest" | "draw"> {
  /** Runs what the form says. */
  readonly submit: (mode: "push" | "replace") => void;
  readonly load: (id: string, hidden: readonly StrategyId[]) => void;
  readonly openLink: (slug: string) => void;
  /** Figures and curves of the scenario under a moving slider. */
  readonly preview: () => void;
  /** Nobody waits for the exact answer any more: what is shown answers what is asked. */
  readonly cancel: () => void;
  /** Asks again for what could not be had. */
  readonly resume: () => void;
}

export function createRequests(
  store: Atom<LabState>,
  { api, labAddress, queries }: Services,
  form: () => LabForm,
): Requests {
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));
  const grace = createTimer(STALE_AFTER_MS, () => patch({ stale: true }));
  const live = createLive({ store, grace, api, labAddress, queries, form });
  let unfinished: (() => void) | null = null;

  const exact = createExactRequests({
    store,
    grace,
    onError: (error, again) => {
      if (isTransient(error)) unfinished = again;
      patch(problemOf(error, form().group));
    },
  });

  const start: typeof exact.start = (request) => {
    live.cancel();
    unfinished = null;
    exact.start(request);
  };

  const cancel = () => {
    live.cancel();
    unfinished = null;
    exact.cancel();
    labAddress.cancelNavigation();
    patch({ busy: false, stale: false, failure: null, serverErrors: NO_ERRORS });
  };

  // Each of the three below changes address, form, table and curves in one turn, once it has all of them: nobody sees,
  // shares or goes back to an address that is not of what is shown.

  const submit: Requests["submit"] = (mode) => {
    const { history, strategies: switchedOn, roads } = store.get();
    const driven = roads > 1 ? switchedOn.filter((id) => !isRecording(id)) : switchedOn; // a recording is of one road
    if (driven.length === 0) {
      cancel();
      return;
    }
    if (mode === "push") labAddress.cancelNavigation();
    const chosen = labAddress.get().view.baseline;
    const { strategies, baseline } = askedStrategies(driven, chosen, { roads, shown: store.get().shown, queries });
    start({
      work: async (signal) => {
        const startedAt = performance.now();
        const { group } = form();
        const asked = history?.present ?? {};
        const run = await api.createRun(withoutGone(group, asked), strategies, signal, {
          ...(roads > 1 && { roads }),
          ...(baseline !== null && { baseline }),
        });
        signal.throwIfAborted();
        queries.setQueryData(runKey(run.id), run);
        if (history === null) patch({ history: begin(run.scenario) });
        const histories = await historiesOf(run, queries, api.series, signal);
        return () => {
          const selected = store.get().strategies;
          const hidden = Object.keys(run.strategies).filter((strategy) => !selected.includes(strategy));
          if (history === null) labAddress.clearFrom();
          labAddress.showRun(run.id, { hidden }, mode);
          patch({
            ...resultsAfterEdit(store.get(), fromRun(run, histories, performance.now() - startedAt, false)),
            drag: null,
            shared: null,
          });
        };
      },
      again: () => submit(mode),
    });
  };

  const load: Requests["load"] = (id, hidden) => {
    start({
      work: async (signal) => {
        const startedAt = performance.now();
        const run = await fromCache(queries, runKey(id), () => api.run(id, signal));
        const histories = await historiesOf(run, queries, api.series, signal);
        return () => {
          const { history } = store.get();
          labAddress.confirmNavigation();
          const { baseline } = labAddress.get().view;
          if (run.comparison && (baseline === DEFAULT_VIEW.baseline || !(baseline in run.strategies)))
            labAddress.setView({ baseline: run.comparison.baseline });
          patch({
            ...resultsAfterOpening(store.get(), fromRun(run, histories, performance.now() - startedAt, true)),
            roads: run.over?.roads ?? 1,
            history: history ? record(history, run.scenario) : begin(run.scenario),
            strategies: Object.keys(run.strategies).filter((strategy) => !hidden.includes(strategy)),
            invalidInput: {},
            drag: null,
            shared: null,
          });
        };
      },
      again: () => load(id, hidden),
      giveUp: leaveLink,
    });
  };

  const openLink: Requests["openLink"] = (slug) => {
    start({
      work: async (signal) => {
        const startedAt = performance.now();
        const link = await fromCache(queries, linkKey(slug), () => api.link(slug, signal));
        if (!link.run && !link.batch) throw new Error("There is nothing behind this link that this page can show");
        const histories = link.run && (await historiesOf(link.run, queries, api.series, signal));
        return () => {
          const { view, strategies, at } = readSharedView(link);
          labAddress.confirmNavigation();
          labAddress.setView(view);
          cursor.set(view.axis, at);
          const shown =
            link.run && histories ? fromRun(link.run, histories, performance.now() - startedAt, true) : null;
          const roads = link.run?.over?.roads ?? 1;
          patch({
            shared: link,
            history: begin(link.scenario),
            strategies,
            roads,
            invalidInput: {},
            drag: null,
            shown,
            latestResult: shown,
            previousResult: null,
          });
        };
      },
      again: () => openLink(slug),
      giveUp: leaveLink,
    });
  };

  /** There is no result at the address, so none is shown. */
  const leaveLink = () => {
    labAddress.confirmNavigation();
    patch({ shared: null, shown: null, latestResult: null, previousResult: null });
  };

  return {
    newest: live.newest,
    draw: live.draw,
    submit,
    load,
    openLink,
    preview: () => {
      exact.cancel();
      labAddress.cancelNavigation();
      const busy = live.follow();
      if (store.get().busy !== busy) patch({ busy }); // each change asks every part of the page whether it is concerned
    },
    cancel,
    resume: () => unfinished?.(),
  };
}

interface ExactRequest {
  /** Gives what shows the answer: done only where nothing else has been asked for meanwhile. */
  readonly work: (signal: AbortSignal) => Promise<() => void>;
  /** Asks for the same once more. */
  readonly again: () => void;
  /** What else to do where it fails for good. */
  readonly giveUp?: () => void;
}

interface Parts {
  readonly store: Atom<LabState>;
  /** Marks what is shown as stale when it ends. */
  readonly grace: Timer;
  readonly onError: (error: unknown, again: () => void) => void;
}

/** One exact request at a time: a new one aborts the one before, so that a stale answer never lands. */
function createExactRequests({ store, grace, onError }: Parts) {
  let current: AbortController | null = null;
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));

  return {
    start: ({ work, again, giveUp }: ExactRequest) => {
      current?.abort();
      const controller = new AbortController();
      const { signal } = controller;
      current = controller;
      patch({ busy: true, failure: null, serverErrors: NO_ERRORS });
      grace.start();
      work(signal)
        .then((show) => {
          if (!signal.aborted) show();
        })
        .catch((error: unknown) => {
          if (signal.aborted) return;
          if (!isAbort(error) && !isTransient(error)) giveUp?.();
          onError(error, again);
        })
        .finally(() => {
          if (signal.aborted) return;
          current = null;
          grace.stop();
          // After a failure the old curves stay dimmed: they are not what the form says.
          patch({ busy: false, stale: store.get().failure !== null || hasErrors(store.get().serverErrors) });
        });
    },
    /** Aborts what runs. */
    cancel: () => {
      if (current === null) return;
      current.abort();
      current = null;
      grace.stop();
    },
  };
}

/** Samples of a curve in a panel, some 400 px wide; half of a whole drive's lie on the bump. */
const BUMP_POINTS = 240;
const POINTS = 2 * BUMP_POINTS;
const POINTS_MOST = 2500;

/** So often what is read follows a moving slider [ms]: each answer is followed by the curves in sight alone. */
const READ_MS = 500;

/** A slider rests when it has not moved for so long [ms]: on a slow machine its moves come further apart than 100 ms. */
const REST_MS = 200;

/** Shades the stages of every panel. */
const ALWAYS_DRAWN = ["brake_pressure"];

/** No recording is asked for while somebody drags: it stays as it was. */
const simulated = (ids: readonly StrategyId[]) => ids.filter((id) => !isRecording(id));

function withRecorded(live: Result, latest: Result | null): Result {
  const recorded = <Part>(all: Readonly<Record<StrategyId, Part>> = {}) =>
    Object.fromEntries(Object.entries(all).filter(([id]) => isRecording(id)));
  const { summaries, series } = latest ?? live;
  return {
    ...live,
    summaries: { ...live.summaries, ...recorded(summaries) },
    series: { ...live.series, ...recorded(series) },
  };
}

interface Asked {
  readonly scenario: Scenario;
  readonly startedAt: number;
}

interface LiveParts extends Services {
  readonly store: Atom<LabState>;
  /** Marks what is shown as stale when it ends. */
  readonly grace: Timer;
  readonly form: () => LabForm;
}

function createLive({ store, grace, api, labAddress, queries, form }: LiveParts) {
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));

  /** Beside the bump samples lie further apart: what shows more takes twice as many, and the more the less it shows. */
  const points = () => {
    const { zoom, axis, differences } = labAddress.get().view;
    if (differences) return ALL_POINTS;
    if (zoom === null) return POINTS;
    const longest = Object.values(store.get().shown?.series ?? {}).map((series) => series[axisKey(axis)]?.at(-1) ?? 0);
    const part = Array.isArray(zoom) ? (zoom[1] - zoom[0]) / Math.max(1e-9, ...longest) : 1;
    return Math.round(Math.min(POINTS_MOST, (2 * POINTS) / Math.max(part, 0.01)));
  };

  /** The bump alone where nothing else is shown: on the time axis each strategy meets it at another time. */
  const partInSight = (): Pick<LiveRequest, "part" | "points"> => {
    const { zoom, axis, differences } = labAddress.get().view;
    const at = cursor.get("distance");
    const { summaries = {} } = newest.get() ?? {};
    const [from, to] = bumpRange(summaries, Object.keys(summaries), "distance") ?? [0, 0];
    const isBumpAlone = zoom === null && axis === "distance" && !differences && (at === null || (at > from && at < to));
    return isBumpAlone ? { part: "bump", points: BUMP_POINTS } : { points: points() };
  };

  const answered = createAtom<Result | null>(null);
  const newest = createAtom(() => {
    const { shown } = store.get();
    return shown?.source === "live" ? answered.get() : shown;
  });

  const inSight = new Set(ALWAYS_DRAWN);
  /** Whether what changes is asked for: from a slider's movement until an exact request begins. */
  let isFollowing = false;
  const request = () => {
    const { drag, strategies } = store.get();
    const asks = isFollowing && drag !== null && simulated(strategies).length > 0;
    if (asks) latest.request({ scenario: drag, startedAt: performance.now() });
    return asks;
  };
  let answeredScenario: Scenario | null = null;
  const isNewest = () => store.get().drag === answeredScenario;
  /** Until an answer is read, also of requests beside: what is overtaken gets none. */
  let isReadNext = true;
  const show = () =>
    patch({
      shown: answered.get(),
      serverErrors: NO_ERRORS,
      failure: null,
      ...(isNewest() ? { busy: false, stale: false } : {}),
    });
  /** Asks again once the slider rests: no event would. */
  const readRest = () => {
    if (isReadNext && isNewest() && store.get().shown !== answered.get()) request();
  };
  const read = () => {
    isReadNext = true;
    readRest();
  };
  const [reading, resting] = [createTimer(READ_MS, read), createTimer(REST_MS, read)];

  const latest = createLatest<Asked, { readonly answer: LiveAnswer; readonly isRead: boolean }>({
    run: async ({ scenario }, signal) => {
      grace.start();
      const { group, signals } = form();
      const { strategies, stale } = store.get();
      const isRead = isReadNext || stale;
      const { baseline } = labAddress.get().view;
      const asked = askedStrategies(simulated(strategies), baseline, { roads: 1, shown: store.get().shown, queries });
      const body = {
        scenario: withoutGone(group, scenario),
        strategies: simulated(asked.strategies),
        ...(asked.baseline !== null && !isRecording(asked.baseline) && { baseline: asked.baseline }),
        ...(isRead ? { signals, points: points() } : { signals: [...inSight], ...partInSight() }),
      };
      return { answer: await api.live(body, signal), isRead };
    },
    onAnswer: ({ answer, isRead }, { scenario, startedAt }) => {
      answeredScenario = scenario;
      if (store.get().drag === null || isNewest()) grace.stop();
      else grace.start();
      if (store.get().drag === null) return;
      answered.set(withRecorded(fromLive(answer, performance.now() - startedAt), store.get().latestResult));
      if (isRead && (isReadNext || store.get().stale)) {
        isReadNext = false;
        reading.start();
        show();
      } else readRest();
    },
    onError: (error) => {
      // While dragging, an overloaded or silent server only means no new curves; the release asks again.
      grace.stop();
      patch({
        busy: false,
        stale: true,
        ...(error instanceof ApiProblem && !isTransient(error) ? refusal(error, form().group) : {}),
      });
    },
    most: 2,
  });
  return {
    newest,
    /** Asks for the scenario under the moving slider; whether there is anything to simulate. */
    follow: () => {
      isFollowing = true;
      resting.start();
      return request();
    },
    cancel: () => {
      isFollowing = false;
      reading.stop();
      resting.stop();
      isReadNext = true;
      latest.cancel();
    },
    draw: (signal: string) => {
      inSight.add(signal);
      request();
      return () => void inSight.delete(signal);
    },
  };
}

/** The strategy that changes refer to, in what is asked of the service: it is computed where it is hidden, too. */
interface Known {
  readonly roads: number;
  readonly shown: Result | null;
  readonly queries: QueryClient;
}

/** Whether the service can be asked for it: one of an old link may have gone, and a recording is of one road. */
function isThere(id: StrategyId, { roads, shown, queries }: Known): boolean {
  if (isRecording(id)) return roads === 1;
  const all = queries.getQueryData<readonly Strategy[]>(strategiesQuery.queryKey);
  return all ? all.some((strategy) => strategy.id === id) : shown !== null && id in shown.summaries;
}

/** The strategies to ask for where these are shown, and the baseline to name; `null` leaves it to the service. */
function askedStrategies(
  shown: readonly StrategyId[],
  baseline: StrategyId,
  known: Known,
): { readonly strategies: readonly StrategyId[]; readonly baseline: StrategyId | null } {
  if (shown.includes(baseline)) return { strategies: shown, baseline };
  return isThere(baseline, known)
    ? { strategies: [...shown, baseline], baseline }
    : { strategies: shown, baseline: null };
}
