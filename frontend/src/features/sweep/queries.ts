/** A batch's rows, column by column. */

import { queryOptions } from "@tanstack/react-query";
import { ask } from "../../api/http";
import type { Batch, BatchTable } from "../../api/types";
import { isFinal } from "../../jobs/follow";

/** Rows are asked for again while a batch runs, the less often the more there are, and soon until there are some [ms]. */
function refreshEvery({ total, done }: Batch, table: BatchTable | undefined): number {
  if (done > 0 && table?.columns.status?.includes("ok") !== true) return 1_000;
  return total <= 1000 || done <= 1000 ? 3_000 : 10_000;
}

export const tableQuery = (batch: Batch | undefined, figures: readonly string[]) =>
  queryOptions({
    // A table of the final state is another one than those before it.
    queryKey: ["batch table", batch?.id ?? "", batch !== undefined && isFinal(batch), figures],
    queryFn: ({ signal }) =>
      ask(
        "get",
        "/batches/{id}/table",
        { path: { id: batch?.id ?? "" }, query: { figures: figures.join(",") } },
        signal,
      ),
    enabled: batch !== undefined && figures.length > 0,
    staleTime: Infinity,
    gcTime: 5 * 60_000,
    refetchInterval: (query) => batch !== undefined && !isFinal(batch) && refreshEvery(batch, query.state.data),
  });
