/** A batch as it stands: read once, then kept up to date by what the server tells. */

import { queryOptions, useQuery, useQueryClient } from "@tanstack/react-query";
import { useEffect, useState } from "react";
import { api } from "../api/client";
import { followBatch, isFinal } from "../api/follow";
import type { Batch, BatchTable } from "../api/types";
import { secondsLeft, withMark, type Mark } from "./pace";

export const batchQuery = (id: string) =>
  queryOptions({ queryKey: ["batch", id], queryFn: ({ signal }) => api.batch(id, signal), staleTime: Infinity });

/** Rows are asked for again while a batch runs, the less often the more there are, and soon until there are some [ms]. */
function refreshEvery({ total, done }: Batch, table: BatchTable | undefined): number {
  if (done > 0 && table?.columns.status?.includes("ok") !== true) return 1_000;
  return total <= 1000 || done <= 1000 ? 3_000 : 10_000;
}

export const tableQuery = (batch: Batch | undefined, figures: readonly string[]) =>
  queryOptions({
    // A table of the final state is another one than those before it.
    queryKey: ["batch table", batch?.id ?? "", batch !== undefined && isFinal(batch), figures],
    queryFn: ({ signal }) => api.batchTable(batch?.id ?? "", figures, signal),
    enabled: batch !== undefined && figures.length > 0,
    staleTime: Infinity,
    gcTime: 5 * 60_000,
    refetchInterval: (query) => batch !== undefined && !isFinal(batch) && refreshEvery(batch, query.state.data),
  });

export interface Followed {
  readonly batch: Batch | undefined;
  readonly error: Error | null;
  readonly connected: boolean;
  /** Seconds, `null` while unknown. */
  readonly left: number | null;
}

export function useBatch(id: string): Followed {
  const queries = useQueryClient();
  const query = useQuery(batchQuery(id));
  const [connected, setConnected] = useState(true);
  const [marks, setMarks] = useState<readonly Mark[]>([]);
  const batch = query.data;
  const unfinished = batch !== undefined && !isFinal(batch);

  useEffect(() => {
    if (!unfinished) return undefined;
    return followBatch(id, {
      onConnected: setConnected,
      onProgress: (progress) => {
        setMarks((all) => withMark(all, { at: performance.now(), finished: progress.done + progress.failed }));
        if (isFinal(progress)) {
          // The events carry counts only: when it ended, and why, stands in the batch itself.
          void queries.invalidateQueries({ queryKey: batchQuery(id).queryKey });
        } else queries.setQueryData(batchQuery(id).queryKey, (known) => known && { ...known, ...progress });
      },
    });
  }, [id, unfinished, queries]);

  const running = batch?.state === "running";
  return { batch, error: query.error, connected, left: running ? secondsLeft(marks, batch.total) : null };
}
