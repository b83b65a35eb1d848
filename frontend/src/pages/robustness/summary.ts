/** What a study's summary holds, as the page reads it. */

import { keepPreviousData, queryOptions } from "@tanstack/react-query";
import { ask } from "../../api/http";
import { isFinal } from "../../jobs/follow";
import type { Batch, BatchSummary, StrategyId, Strategy } from "../../api/types";
import type { Metric } from "../../server/metrics";
import type { Opening } from "../../features/sweep/useOpenRun";

export type StrategySummary = BatchSummary["strategies"][string];
export type FigureSummary = StrategySummary["figures"][string];
export type Margin = NonNullable<FigureSummary["margin"]>;
export type ExtremeRun = NonNullable<FigureSummary["highest"]>;
export type Sensitivity = FigureSummary["sensitivity"][number];

export const TRAVEL = "events.travel_exceeded_mm";
export const AIRBORNE = "events.airborne_ms";

const REFRESH_MS = 5_000;

export const summaryQuery = (batch: Batch, figures: readonly string[], baseline: StrategyId | null) =>
  queryOptions({
    // A summary of the final state is another one than those before it.
    queryKey: ["batch summary", batch.id, isFinal(batch), figures, baseline],
    queryFn: ({ signal }) =>
      ask(
        "get",
        "/batches/{id}/summary",
        { path: { id: batch.id }, query: { figures: figures.join(","), baseline } },
        signal,
      ),
    enabled: batch.done > 0 || isFinal(batch),
    staleTime: Infinity,
    gcTime: 5 * 60_000,
    placeholderData: keepPreviousData,
    refetchInterval: !isFinal(batch) && REFRESH_MS,
  });

/** The value at that percentage; `null` where there is none. */
export function quantile(
  summary: Pick<BatchSummary, "quantiles">,
  { quantiles }: Pick<FigureSummary, "quantiles">,
  percent: number,
): number | null {
  return quantiles?.[summary.quantiles.indexOf(percent)] ?? null;
}

/** What chance makes more often than this is not shown: a table has about a hundred of them. */
const CHANCE = 0.001;

export const matters = ({ p_value: chance }: Sensitivity) => chance < CHANCE;

export interface Ranked {
  readonly field: string;
  /** By figure. */
  readonly cells: Readonly<Record<string, Sensitivity>>;
  readonly most: number;
}

/** Fields by what they explain of whichever figure follows them most. */
export function ranked(sensitivities: Readonly<Record<string, readonly Sensitivity[]>>): readonly Ranked[] {
  const names = [...new Set(Object.values(sensitivities).flatMap((list) => list.map(({ field }) => field)))];
  return names
    .map((field): Ranked => {
      const cells = Object.fromEntries(
        Object.entries(sensitivities).flatMap(([figure, list]) =>
          list.filter((each) => each.field === field).map((each) => [figure, each] as const),
        ),
      );
      return { field, cells, most: Math.max(...Object.values(cells).map(({ effect }) => effect)) };
    })
    .sort((a, b) => b.most - a.most);
}

/** What a study's page gives its cards. */
export interface StudyParts {
  readonly batch: Batch;
  readonly summary: BatchSummary;
  /** The study's, in the catalogue's order. */
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Metric[];
  readonly opening: Opening;
}
