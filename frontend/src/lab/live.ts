/** Figures and curves while a slider moves: two requests at a time, the newest next. */

import { ApiProblem, isTransient } from "../api/problem";
import type { LiveAnswer, Scenario, StrategyId } from "../api/types";
import type { LabForm, Services, LabState } from "./labState";
import { isRecording } from "../lib/recording";
import { createLatest } from "../lib/latest";
import { NO_ERRORS, refusal } from "./problems";
import { ALL_POINTS } from "../server/queries";
import { axisKey } from "./resultView";
import { fromLive, type Result } from "./result";
import { withoutGone } from "../scenario/ownOptions";
import { createAtom, type Atom } from "@tanstack/react-store";
import { createTimer, type Timer } from "../lib/timer";

const POINTS = 700;
const POINTS_MOST = 2500;

/** So often what is read follows [ms]: curves alone follow each answer. */
const READ_MS = 200;

/** No recording is asked for while somebody drags: it stays as it was. */
const simulated = (ids: readonly StrategyId[]) => ids.filter((id) => !isRecording(id));

function withRecorded(live: Result, exact: Result | null): Result {
  const recorded = <Part>(all: Readonly<Record<StrategyId, Part>> = {}) =>
    Object.fromEntries(Object.entries(all).filter(([id]) => isRecording(id)));
  const { summaries, series } = exact ?? live;
  return {
    ...live,
    summaries: { ...live.summaries, ...recorded(summaries) },
    series: { ...live.series, ...recorded(series) },
  };
}

interface LiveRequest {
  readonly scenario: Scenario;
  readonly startedAt: number;
}

interface Parts extends Pick<Services, "api" | "labAddress"> {
  readonly store: Atom<LabState>;
  /** Marks what is shown as stale when it ends. */
  readonly grace: Timer;
  readonly form: () => LabForm;
}

export function createLive({ store, grace, api, labAddress, form }: Parts) {
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));

  /** The bump has half of all samples; zoomed in by hand, the same density takes more of them over the whole run. */
  const points = () => {
    const { zoom, axis, differences } = labAddress.get().view;
    if (differences) return ALL_POINTS;
    const longest = Object.values(store.get().shown?.series ?? {}).map((series) => series[axisKey(axis)]?.at(-1) ?? 0);
    const part = Array.isArray(zoom) ? (zoom[1] - zoom[0]) / Math.max(1e-9, ...longest) : 1;
    return Math.round(Math.min(POINTS_MOST, POINTS / Math.max(part, 0.01)));
  };

  const answered = createAtom<Result | null>(null);
  const newest = createAtom(() => {
    const { shown } = store.get();
    return shown?.source === "live" ? answered.get() : shown;
  });

  let asked: Scenario | null = null;
  const isNewest = () => store.get().drag === asked;
  const show = () =>
    patch({
      shown: answered.get(),
      serverErrors: NO_ERRORS,
      failure: null,
      ...(isNewest() ? { busy: false, stale: false } : {}),
    });
  const reading = createTimer(READ_MS, show);

  const latest = createLatest<LiveRequest, LiveAnswer>({
    run: ({ scenario }, signal) => {
      grace.start();
      const { group } = form();
      const sent = withoutGone(group, scenario);
      return api.live(
        { scenario: sent, strategies: simulated(store.get().strategies), signals: form().signals, points: points() },
        signal,
      );
    },
    onAnswer: (answer, { scenario, startedAt }) => {
      const { shown, stale, latestResult } = store.get();
      asked = scenario;
      if (isNewest()) grace.stop();
      else grace.start();
      answered.set(withRecorded(fromLive(answer, performance.now() - startedAt), latestResult));
      if (shown?.source !== "live" || stale) show();
      else if (!reading.isRunning()) reading.start();
    },
    onError: (error) => {
      // While dragging, an overloaded or silent server only means no new curves; the release asks again.
      grace.stop();
      reading.stop();
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
    request: (scenario: Scenario) => latest.request({ scenario, startedAt: performance.now() }),
    cancel: () => {
      reading.stop();
      latest.cancel();
    },
  };
}
