/** Time histories of a run, or why there are none. */

import type { QueryClient } from "@tanstack/react-query";
import { ApiProblem, isTransient } from "../api/problem";
import type { Run, SeriesByStrategy, StrategyId } from "../api/types";
import { fromCache, OVERVIEW_POINTS, seriesKey } from "../server/queries";
import type { Histories } from "./result";

/** What is final about missing time histories is told in their place; anything else may still pass. */
function withoutSeries(error: unknown): Histories {
  if (error instanceof ApiProblem && !isTransient(error)) return { series: {}, missing: error.message };
  throw error;
}

/** One that could not be computed takes nothing from the others. */
const computedOf = ({ strategies }: Pick<Run, "strategies">): readonly StrategyId[] =>
  Object.entries(strategies).flatMap(([id, { status }]) => (status === "ok" ? [id] : []));

const NOTHING_COMPUTED = "None of its strategies could be computed.";

type FetchSeries = (
  id: string,
  strategies: readonly StrategyId[],
  points: number,
  signal: AbortSignal,
) => Promise<SeriesByStrategy>;

/** From the cache, or fetched under the caller's signal: whoever asks for something else stops this as well. */
export async function historiesOf(
  run: Run,
  queries: QueryClient,
  fetchSeries: FetchSeries,
  signal: AbortSignal,
): Promise<Histories> {
  const ids = computedOf(run);
  if (ids.length === 0) return { series: {}, missing: NOTHING_COMPUTED };
  const key = seriesKey(run.id, ids, OVERVIEW_POINTS);
  try {
    const series = await fromCache(queries, key, () => fetchSeries(run.id, ids, OVERVIEW_POINTS, signal));
    return { series, missing: null };
  } catch (error) {
    return withoutSeries(error);
  }
}
