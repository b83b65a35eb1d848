/** The table's entries: each strategy that is on in the shown result, then in each pinned variant. */

import type {
  Catalogue,
  JsonValue,
  Scenario,
  Strategy,
  Summary,
  Interval,
  OverRoads,
  Quantity,
  StrategyId,
} from "../../api/types";
import { whyNotCompared } from "../../lab/compare";
import type { ResultView } from "../../lab/resultView";
import type { Result } from "../../lab/result";
import { valueAt, type MetricPath, type WindowMetric } from "../../lab/metricPath";
import { pointerOf } from "../../scenario/fields";
import { getAt } from "../../scenario/path";
import { formatNumber, formatResult } from "../../units/format";
import { areAlike, changeAgainst, pairedChange, type Change } from "./change";

export interface Entry {
  readonly key: string;
  readonly strategy: Strategy;
  /** The variant's name; `null` for the result that is shown. */
  readonly variant: string | null;
  readonly shown: Result;
  readonly summary: Summary | undefined;
  /** Why it has none. */
  readonly fault: string | undefined;
  /** Whether changes are against this one: it has none. */
  readonly isBaseline: boolean;
}

export interface EntryGroup {
  /** A pinned variant's name; `null` for the result that is shown. */
  readonly name: string | null;
  readonly entries: readonly Entry[];
}

/** The shown result's name beside those of variants. */
export const CURRENT = "Current scenario";

export function entryGroups({
  shown,
  catalogue,
  ids,
  faults,
  pins,
  reference,
  baseline,
}: ResultView): readonly EntryGroup[] {
  const group = (name: string | null, of: Result): EntryGroup => ({
    name,
    entries: catalogue
      .filter(({ id }) => (ids.includes(id) || id in faults) && (name === null || id in of.summaries))
      .map((strategy) => ({
        key: `${name === null ? "" : (of.runId ?? "")} ${strategy.id}`,
        strategy,
        variant: name,
        shown: of,
        summary: of.summaries[strategy.id],
        fault: name === null ? faults[strategy.id] : undefined,
        isBaseline:
          reference === null ? strategy.id === baseline : of.runId !== null && of.runId === reference.shown.runId,
      })),
  });
  const others = pins.filter((pin) => pin.shown.runId !== shown.runId);
  return [group(null, shown), ...others.map(({ name, shown: pinned }) => group(name, pinned))];
}

/** The lowest of a metric, which every table prints in bold. */
export const lowestOf = (groups: readonly EntryGroup[], metric: MetricPath): number =>
  Math.min(...groups.flatMap(({ entries }) => entries.map(({ summary }) => valueAt(summary, metric) ?? Infinity)));

const NONE: Change = { percent: null, half: 0, verdict: "none" };

/**
 * The change of an entry's number: against the same strategy of that variant, or against the baseline of its own
 * variant; `null` for what changes are against, and until the change is there.
 */
export function changeOf(resultView: ResultView, entry: Entry, metric: MetricPath, scale = 1): Change | null {
  if (entry.isBaseline) return null;
  const base = baseOf(resultView, entry);
  if (base === null) return NONE;
  const { over, runId } = entry.shown;
  const paired =
    over !== null && resultView.reference === null && over.baseline === resultView.baseline
      ? over.changes
      : resultView.roadPairedChanges[runId ?? ""];
  return changeBetween(entry, base, { metric, scale, paired });
}

interface ChangeQuestion {
  readonly metric: MetricPath;
  /** From SI to the unit shown. */
  readonly scale?: number;
  /** What the result's roads say against the base; undefined until they do. */
  readonly paired: OverRoads["changes"] | undefined;
}

/** The change of one strategy's number against that of another, or of its own in another result; `null` until it is there. */
export function changeBetween(
  { strategy, shown, summary }: Pick<Entry, "strategy" | "shown" | "summary">,
  base: Base,
  { metric, scale = 1, paired }: ChangeQuestion,
): Change | null {
  if (shown.over && !("run" in metric)) {
    const change = pairedAt(paired, strategy.id, metric);
    if (paired === undefined) return null;
    return change
      ? pairedChange(change, areAlike(valueAt(summary, metric), valueAt(base.summary, metric), scale))
      : NONE;
  }
  return changeAgainst(valueAt(summary, metric), valueAt(base.summary, metric), {
    scale,
    oneRoadNoise: oneRoadNoiseOf(base.pair, metric, isRandom(shown.scenario) || isRandom(base.scenario)),
  });
}

/** What a number is compared with. */
export interface Base {
  readonly summary: Summary | undefined;
  readonly scenario: Scenario;
  /** The strategies that are compared. */
  readonly pair: readonly Strategy[];
}

/** What an entry's changes refer to; `null` where there is nothing of the kind. */
function baseOf({ reference, baseline, catalogue }: ResultView, { strategy, shown }: Entry): Base | null {
  const [result, id] = reference ? [reference.shown, strategy.id] : [shown, baseline ?? ""];
  const summary = result.summaries[id];
  if (summary === undefined || whyNotCompared(shown, result) !== null) return null;
  return {
    summary,
    scenario: result.scenario,
    pair: catalogue.filter((each) => each.id === strategy.id || each.id === id),
  };
}

/** The mean's interval over several roads. */
export function intervalAt({ over }: Result, strategy: StrategyId, metric: MetricPath): Interval | undefined {
  const estimates = over?.estimates[strategy];
  if ("run" in metric) return undefined;
  if ("comfort" in metric) return estimates?.comfort[metric.comfort];
  return estimates?.metrics[metric.window]?.[metric.signal]?.[metric.statistic];
}

/** The paired change: `null` against zero, undefined where there is none. */
function pairedAt(
  changes: OverRoads["changes"] | undefined,
  strategy: StrategyId,
  metric: MetricPath,
): Interval | null | undefined {
  const own = changes?.[strategy];
  if ("run" in metric) return undefined;
  if ("comfort" in metric) return own?.comfort[metric.comfort];
  return own?.[metric.window][metric.signal]?.[metric.statistic];
}

/** Smaller changes [%] between these strategies may be the random variation of one road; times, speeds and what is not random have none. */
export function oneRoadNoiseOf(
  strategies: readonly Pick<Strategy, "one_road_resolution">[],
  metric: MetricPath,
  random: boolean,
): number {
  if ("run" in metric || !random) return 0;
  const statistic = "comfort" in metric ? "rms" : metric.statistic;
  return Math.max(...strategies.map((strategy) => strategy.one_road_resolution[statistic] ?? 0));
}

/** By dotted name the values with which nothing in a result is random, as `Scenario.is_random` of the core has it. */
const NOT_RANDOM: Readonly<Record<string, JsonValue>> = {
  "road.roughness": 0,
  "road.profile": null,
  "mismatch.preview_noise": 0,
  "estimation.kind": "exact",
  "hil.noise": 0,
  "hil.jitter": 0,
  "hil.packet_loss": 0,
};

/** Whether another seed gives other results, whatever the varied fields are. */
export const isRandom = (scenario: Scenario, varied: readonly string[] = []): boolean =>
  Object.entries(NOT_RANDOM).some(
    ([name, value]) => varied.includes(name) || getAt(scenario, pointerOf(name)) !== value,
  );

export interface WindowView {
  readonly window: "rough_road" | "bump";
  readonly statistic: "rms" | "peak";
}

/** The paper's two views of a run: which statistic over which window. */
export const VIEWS: readonly WindowView[] = [
  { window: "rough_road", statistic: "rms" },
  { window: "bump", statistic: "peak" },
];

/** The paper's eight metrics. */
export const comparedMetrics = ({ paper_signals }: Pick<Catalogue, "paper_signals">): readonly WindowMetric[] =>
  VIEWS.flatMap((view) => paper_signals.map((signal) => ({ ...view, signal })));

/** A number or an event of a run: whole numbers stay whole. */
export function showValue(value: number | boolean | null | undefined): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value !== "number") return "–";
  return Number.isInteger(value)
    ? formatNumber(value, Math.max(1, String(Math.abs(value)).length))
    : formatResult(value);
}

/** A row of comfort, time and events. */
export interface RunRow {
  readonly quantity: Quantity;
  /** Where its number stands; an event has none. */
  readonly metric: MetricPath | null;
  /** Lower is better, so that a change has a verdict. */
  readonly judged: boolean;
}

export function runRows(catalogue: Catalogue): readonly RunRow[] {
  return [
    ...catalogue.comfort.map((quantity) => ({ quantity, metric: { comfort: quantity.key }, judged: true })),
    ...catalogue.run_figures.map((quantity) => ({
      quantity,
      metric: { run: quantity.key },
      judged: quantity.key === "travel_time",
    })),
    ...catalogue.events.map((quantity) => ({ quantity, metric: null, judged: false })),
  ];
}
