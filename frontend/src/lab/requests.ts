/** What the lab asks of the server, and how an answer changes what is shown. */

import { isTransient, isAbort } from "../api/problem";
import type { StrategyId } from "../api/types";
import { DEFAULT_VIEW } from "./address";
import { askedStrategies } from "./baseline";
import { cursor } from "./cursor";
import { historiesOf } from "./histories";
import { begin, record } from "./history";
import type { Lab, LabState, LabForm, Services } from "./labState";
import { createLive } from "./live";
import { NO_ERRORS, problemOf, hasErrors } from "./problems";
import { fromCache, linkKey, runKey } from "../server/queries";
import { readSharedView } from "./sharing";
import { fromRun, resultsAfterEdit, resultsAfterOpening } from "./result";
import type { Atom } from "@tanstack/react-store";
import { isRecording } from "../lib/recording";
import { createTimer, type Timer } from "../lib/timer";
import { withoutGone } from "../scenario/differences";

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
