/** A tuning as it stands: read once, and again whenever the server tells of something new. */

import { keepPreviousData, queryOptions, useQuery, useQueryClient } from "@tanstack/react-query";
import { useEffect, useState } from "react";
import { api } from "../api/client";
import { follow, isFinal } from "../api/follow";
import type { Tuning } from "../api/types";
import { secondsLeft, withMark, type Mark } from "../batch/pace";

export const tuningQuery = (id: string) => queryOptions({ queryKey: ["tuning", id], queryFn: ({ signal }) => api.tuning(id, signal), staleTime: Infinity });

export const tuningsQuery = queryOptions({ queryKey: ["tunings"], queryFn: ({ signal }) => api.tunings(signal), staleTime: 0 });

/** Every trial so far: asked for anew with every generation. */
export const trialsQuery = (tuning: Tuning) =>
  queryOptions({
    queryKey: ["tuning trials", tuning.id, tuning.trials.done + tuning.trials.failed],
    queryFn: ({ signal }) => api.tuningTrials(tuning.id, signal),
    staleTime: Infinity,
    gcTime: 60_000,
    placeholderData: keepPreviousData,
  });

const REPLAY_MS = 1000;

const hasCounts = (value: unknown): value is { readonly done: number; readonly failed: number } =>
  typeof value === "object" && value !== null && "done" in value && "failed" in value;

function read(text: string): { readonly done: number; readonly failed: number } | null {
  try {
    const value: unknown = JSON.parse(text);
    return hasCounts(value) ? value : null;
  } catch {
    return null;
  }
}

export interface Followed {
  readonly tuning: Tuning | undefined;
  readonly error: Error | null;
  readonly connected: boolean;
  /** Seconds of the search, `null` while unknown. */
  readonly left: number | null;
}

export function useTuning(id: string): Followed {
  const queries = useQueryClient();
  const query = useQuery(tuningQuery(id));
  const [connected, setConnected] = useState(true);
  const [marks, setMarks] = useState<readonly Mark[]>([]);
  const tuning = query.data;
  const unfinished = tuning !== undefined && !isFinal(tuning);

  useEffect(() => {
    if (!unfinished) return undefined;
    const opened = performance.now();
    return follow(
      {
        address: (after) => api.tuningEventsAddress(id, after),
        events: ["state", "progress", "restart"],
        read,
        // A resumed tuning tells on after a final state: this page knows by the tuning itself when it has ended.
        isLast: () => false,
      },
      {
        onConnected: setConnected,
        onProgress: ({ done, failed }) => {
          const mark = { at: performance.now(), finished: done + failed };
          // What is told again of the past comes all at once and says nothing of the pace.
          setMarks((all) => (mark.at - opened < REPLAY_MS ? [mark] : withMark(all, mark)));
          void queries.invalidateQueries({ queryKey: tuningQuery(id).queryKey });
        },
      },
    );
  }, [id, unfinished, queries]);

  const searching = tuning?.state === "running" && tuning.step === "search";
  return { tuning, error: query.error, connected, left: searching ? secondsLeft(marks, tuning.trials.total) : null };
}
