/** The table's entries: each strategy that is on in the shown result, then in each pinned variant. */

import type { Strategy, Summary } from "../api/types";
import type { Scene } from "../state/scene";
import { roadsOf, type Shown } from "../state/shown";
import { changeAgainst, pairedChange, separateChange, type Change } from "./change";
import { intervalAt, pairedAt, valueAt, type MetricPath } from "./metric";

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
 * variant; `null` for what changes are against.
 */
export function changeOf({ against, baseline }: Scene, { strategy, shown, summary, isBaseline }: Entry, metric: MetricPath, scale = 1): Change | null {
  if (isBaseline) return null;
  const value = valueAt(summary, metric);
  if (against === null) {
    const paired = pairedAt(shown, strategy.id, baseline, metric);
    if (paired) return pairedChange(paired);
    return changeAgainst(value, baseline === null ? null : valueAt(shown.summaries[baseline], metric), scale);
  }
  // A mean over roads and one road's number differ by the luck of the road.
  if (roadsOf(shown) !== roadsOf(against.shown)) return NONE;
  const [one, other] = [intervalAt(shown, strategy.id, metric), intervalAt(against.shown, strategy.id, metric)];
  if (one && other) return separateChange(one, other);
  return changeAgainst(value, valueAt(against.shown.summaries[strategy.id], metric), scale);
}
