/** What the last edit changed, metric by metric and strategy by strategy. */

import type { Catalogue, OverRoads, Strategy, StrategyId } from "../../api/types";
import type { Variant } from "../../lab/compare";
import type { ResultView } from "../../lab/resultView";
import type { Change } from "../tables/change";
import { changeBetween, comparedMetrics } from "../tables/entries";
import { type WindowMetric } from "../../lab/metricPath";

export interface EditChange {
  readonly strategy: StrategyId;
  readonly metric: WindowMetric;
  /** `null` until it is there. */
  readonly change: Change | null;
}

/** Each strategy's eight metrics against its own before. */
export function editChanges(
  { shown, strategies, summaries }: Pick<ResultView, "shown" | "strategies" | "summaries">,
  before: Variant,
  catalogue: Pick<Catalogue, "paper_signals">,
  paired: OverRoads["changes"] | undefined,
): readonly EditChange[] {
  return strategies.flatMap((strategy) =>
    comparedMetrics(catalogue).map((metric) => ({
      strategy: strategy.id,
      metric,
      change: changeBetween(
        { strategy, shown, summary: summaries[strategy.id] },
        { summary: before.shown.summaries[strategy.id], pair: [strategy] },
        { metric, paired },
      ),
    })),
  );
}

/** The strategy that the edit moved in most metrics; the first where it moved none. */
export function changedMost(changes: readonly EditChange[], strategies: readonly Strategy[]): Strategy | undefined {
  const moved = ({ id }: Strategy) =>
    changes.filter(
      ({ strategy, change }) => strategy === id && change !== null && change.percent !== null && change.percent !== 0,
    ).length;
  return strategies.toSorted((one, other) => moved(other) - moved(one))[0];
}

/** `Front tyre` of `Front tyre dynamic load`: enough beside its plot's window. */
export const shortName = (label: string): string => label.replace(/ (acceleration|dynamic load)$/, "");
