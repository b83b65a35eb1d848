/** What the plots and tables show: one complete answer, exact or live. */

import { sameValue } from "../scenario/path";
import type {
  Caution,
  Characteristics,
  Comparison,
  Failure,
  LiveAnswer,
  OverRoads,
  Run,
  Scenario,
  SeriesByStrategy,
  StrategyId,
  Summary,
} from "../api/types";
import type { History } from "./history";

export interface Timing {
  readonly cached: number;
  readonly computed: number;
  /** The server's own time, where it says so [ms]. */
  readonly computeMs: number;
  /** From asking to having the answer, as this page saw it [ms]. */
  readonly roundTripMs: number;
  /** The run was opened by its address: nothing was asked to be computed. */
  readonly opened: boolean;
}

export interface Failed {
  readonly strategy: StrategyId;
  readonly message: string;
}

const NO_CAUTIONS: readonly Caution[] = [];

export interface Result {
  readonly source: "exact" | "live";
  readonly runId: string | null;
  readonly coreVersion: string;
  readonly scenario: Scenario;
  /** What the vehicle’s values come to. */
  readonly characteristics: Characteristics | undefined;
  /** Warnings about values outside a car's usual range, and about results that are not comparable. */
  readonly cautions: readonly Caution[];
  /** What its strategies mean beside each other, as the service says it. */
  readonly comparison: Comparison | undefined;
  readonly summaries: Readonly<Record<StrategyId, Summary>>;
  readonly failed: readonly Failed[];
  /** What several roads say: then the summaries are means, and curves and events are the first road's. */
  readonly over: OverRoads | null;
  readonly series: SeriesByStrategy;
  /** Why there are no time histories; `null` where there are. */
  readonly missing: string | null;
  readonly timing: Timing;
}

type Answers = Readonly<Record<StrategyId, Summary | Failure>>;

export function split(all: Answers): Pick<Result, "summaries" | "failed"> {
  const summaries: Record<StrategyId, Summary> = {};
  const failed: Failed[] = [];
  for (const [strategy, answer] of Object.entries(all)) {
    if (answer.status === "ok") summaries[strategy] = answer;
    else failed.push({ strategy, message: answer.reason });
  }
  return { summaries, failed };
}

function timing(all: Answers, roundTripMs: number, opened: boolean): Timing {
  const list = Object.values(all);
  const cached = list.filter((summary) => summary.cached === true).length;
  const computeMs = list.reduce((sum, summary) => sum + (summary.cached ? 0 : summary.compute_ms), 0);
  return { cached, computed: list.length - cached, computeMs, roundTripMs, opened };
}

export type Histories = Pick<Result, "series" | "missing">;

export function fromRun(run: Run, { series, missing }: Histories, roundTripMs: number, opened: boolean): Result {
  return {
    source: "exact",
    runId: run.id,
    coreVersion: run.core_version,
    scenario: run.scenario,
    characteristics: run.characteristics,
    cautions: run.comparison?.cautions ?? NO_CAUTIONS,
    comparison: run.comparison,
    ...split(run.strategies),
    over: run.over,
    series,
    missing,
    timing: timing(run.strategies, roundTripMs, opened),
  };
}

export function fromLive(answer: LiveAnswer, roundTripMs: number): Result {
  const { summaries, failed } = split(answer.strategies);
  return {
    source: "live",
    runId: null,
    coreVersion: answer.core_version,
    scenario: answer.scenario,
    characteristics: answer.characteristics,
    cautions: answer.comparison?.cautions ?? NO_CAUTIONS,
    comparison: answer.comparison,
    summaries,
    failed,
    over: null,
    series: answer.series,
    missing: null,
    timing: timing(answer.strategies, roundTripMs, false),
  };
}

export const roadsOf = ({ over }: Result): number => over?.roads ?? 1;

interface Results {
  readonly shown: Result | null;
  readonly latestResult: Result | null;
  readonly previousResult: Result | null;
}

/** Whether a controller of one's own was another one: its file was saved in between. */
const hasOtherLaw = (one: Result, other: Result) =>
  Object.entries(one.summaries).some(([id, { source }]) => {
    const now = other.summaries[id]?.source;
    return source && now && source.digest !== now.digest;
  });

const isOther = (latest: Result | null, next: Result) =>
  latest !== null && (!sameValue(latest.scenario, next.scenario) || hasOtherLaw(latest, next));

/** A new exact result is shown. The one of another scenario before it stays to compare with. */
export function resultsAfterEdit({ latestResult, previousResult }: Results, next: Result): Results {
  return {
    shown: next,
    latestResult: next,
    previousResult: isOther(latestResult, next) ? latestResult : previousResult,
  };
}

/** An exact result is opened: what was shown before it is not the state before an edit. */
export function resultsAfterOpening({ latestResult, previousResult }: Results, next: Result): Results {
  return { shown: next, latestResult: next, previousResult: isOther(latestResult, next) ? null : previousResult };
}

/** The state before the edit that is shown, one under way included. */
export const beforeEdit = ({ shown, latestResult, previousResult }: Results): Result | null =>
  shown?.source === "live" ? latestResult : previousResult;

/** Whether the last step led back from this result: it can be done again. */
export const isUndone = ({ scenario }: Result, history: History<Scenario> | null): boolean =>
  history?.future.some((undone) => sameValue(undone, scenario)) ?? false;

/** Whether a result answers this question, for some of its strategies. */
export function answers(
  shown: Result,
  question: {
    readonly scenario: Scenario | undefined;
    readonly roads: number;
    readonly strategies: readonly StrategyId[];
  },
): boolean {
  const { source, scenario, summaries } = shown;
  return (
    source === "exact" &&
    roadsOf(shown) === question.roads &&
    question.strategies.every((id) => id in summaries) &&
    sameValue(scenario, question.scenario)
  );
}
