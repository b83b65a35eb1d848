/** The strategy that changes refer to, in what is asked of the service: it is computed where it is hidden, too. */

import type { QueryClient } from "@tanstack/react-query";
import type { Strategy, StrategyId } from "../api/types";
import { isRecording } from "../lib/recording";
import { strategiesQuery } from "../server/queries";
import type { Result } from "./result";

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
export function askedStrategies(
  shown: readonly StrategyId[],
  baseline: StrategyId,
  known: Known,
): { readonly strategies: readonly StrategyId[]; readonly baseline: StrategyId | null } {
  if (shown.includes(baseline)) return { strategies: shown, baseline };
  return isThere(baseline, known)
    ? { strategies: [...shown, baseline], baseline }
    : { strategies: shown, baseline: null };
}
