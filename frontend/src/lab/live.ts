/** Figures and curves while a slider moves: two requests at a time, the newest next. */

import { ApiProblem, isTransient } from "../api/problem";
import type { LiveAnswer, LiveRequest, Scenario, StrategyId } from "../api/types";
import type { LabForm, Services, LabState } from "./labState";
import { isRecording } from "../lib/recording";
import { createLatest } from "../lib/latest";
import { NO_ERRORS, refusal } from "./problems";
import { ALL_POINTS } from "../server/queries";
import { cursor } from "./cursor";
import { askedStrategies } from "./baseline";
import { axisKey, bumpRange } from "./resultView";
import { fromLive, type Result } from "./result";
import { createAtom, type Atom } from "@tanstack/react-store";
import { createTimer, type Timer } from "../lib/timer";
import { withoutGone } from "../scenario/differences";

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

interface Parts extends Services {
  readonly store: Atom<LabState>;
  /** Marks what is shown as stale when it ends. */
  readonly grace: Timer;
  readonly form: () => LabForm;
}

export function createLive({ store, grace, api, labAddress, queries, form }: Parts) {
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
