/** The table's entries: each strategy that is on in the shown result, then in each pinned variant. */

import type { Strategy, Summary } from "../../api/types";
import { whyNotCompared } from "../../lab/compare";
import type { Scene } from "../../lab/resultView";
import type { Shown } from "../../lab/result";
import { changeAgainst, pairedChange, type Change } from "./change";
import { luckOf, pairedAt, valueAt, type MetricPath } from "./metric";

export interface Entry {
  readonly key: string;
  readonly strategy: Strategy;
  readonly shown: Shown;
  readonly summary: Summary | undefined;
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

export function entryGroups({ shown, strategies, pins, against, baseline }: Scene): readonly EntryGroup[] {
  const group = (name: string | null, of: Shown): EntryGroup => ({
    name,
    entries: strategies
      .filter(({ id }) => name === null || id in of.summaries)
      .map((strategy) => ({
        key: `${name === null ? "" : (of.runId ?? "")} ${strategy.id}`,
        strategy,
        shown: of,
        summary: of.summaries[strategy.id],
        isBaseline: against === null ? strategy.id === baseline : of.runId !== null && of.runId === against.shown.runId,
      })),
  });
  const others = pins.filter((pin) => pin.shown.runId !== shown.runId);
  return [group(null, shown), ...others.map(({ name, shown: pinned }) => group(name, pinned))];
}

const NONE: Change = { percent: null, half: 0, verdict: "none" };

/**
 * The change of an entry's number: against the same strategy of that variant, or against the baseline of its own
 * variant; `null` for what changes are against, and until the change is there.
 */
export function changeOf(scene: Scene, entry: Entry, metric: MetricPath, scale = 1): Change | null {
  if (entry.isBaseline) return null;
  const base = baseOf(scene, entry);
  if (base === null) return NONE;
  const { strategy, shown, summary } = entry;
  const { over, runId } = shown;
  if (over && !("run" in metric)) {
    const changes =
      scene.against === null && over.baseline === scene.baseline ? over.changes : scene.paired[runId ?? ""];
    const change = pairedAt(changes, strategy.id, metric);
    return changes === undefined ? null : change ? pairedChange(change) : NONE;
  }
  return changeAgainst(valueAt(summary, metric), valueAt(base.summary, metric), {
    scale,
    luck: luckOf(base.pair, metric),
  });
}

interface Base {
  readonly summary: Summary;
  /** The strategies that are compared. */
  readonly pair: readonly Strategy[];
}

/** What an entry's changes refer to; `null` where there is nothing of the kind. */
function baseOf({ against, baseline, catalogue }: Scene, { strategy, shown }: Entry): Base | null {
  const [result, id] = against ? [against.shown, strategy.id] : [shown, baseline ?? ""];
  const summary = result.summaries[id];
  if (summary === undefined || whyNotCompared(shown, result) !== null) return null;
  return { summary, pair: catalogue.filter((each) => each.id === strategy.id || each.id === id) };
}
