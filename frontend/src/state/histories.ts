/** Time histories of a run, or why there are none. */

import type { QueryClient } from "@tanstack/react-query";
import { ApiProblem, isTransient } from "../api/problem";
import type { Run } from "../api/types";
import { OVERVIEW_POINTS, seriesQuery } from "./queries";
import type { Histories } from "./shown";

/** What is final about missing time histories is told in their place; anything else may still pass. */
function withoutSeries(error: unknown): Histories {
  if (error instanceof ApiProblem && !isTransient(error)) return { series: {}, missing: error.message };
  throw error;
}

export async function historiesOf(run: Run, queries: QueryClient): Promise<Histories> {
  // One that could not be computed takes nothing from the others.
  const ids = Object.entries(run.strategies).flatMap(([id, { status }]) => (status === "ok" ? [id] : []));
  if (ids.length === 0) return { series: {}, missing: "None of its strategies could be computed." };
  return queries.query(seriesQuery(run.id, ids, OVERVIEW_POINTS)).then((series) => ({ series, missing: null }), withoutSeries);
}
