/** The pinned variants: one's own, or those of the link that is shown; each with its result once that is there. */

import { useQueries, useQueryClient, type QueryClient } from "@tanstack/react-query";
import { api } from "../../api/client";
import { isNotFound, Unreachable } from "../../api/problem";
import type { Run } from "../../api/types";
import { useLab } from "../../lab/context";
import { historiesOf } from "../../lab/histories";
import { createPins, type Pin } from "../../lab/pins";
import { runKey } from "../../server/queries";
import { fromRun, type Shown } from "../../lab/result";
import { ownStorage } from "../../lib/storage";
import { useStore } from "../../lib/store";

/** Those of this browser. */
export const ownPins = createPins(ownStorage());

export interface PinnedRun extends Pin {
  /** `null` until it is there. */
  readonly shown: Shown | null;
  /** Why it is not shown; `null` where it is. */
  readonly missing: string | null;
  /** The server has it no more. */
  readonly isGone: boolean;
}

export const pinnedKey = (run: string) => ["pinned", run] as const;

/** The pinned run; where the lab drives another number of roads, its scenario over as many. */
async function pinnedRun(id: string, roads: number | null, queries: QueryClient, signal: AbortSignal): Promise<Run> {
  const run = queries.getQueryData<Run>(runKey(id)) ?? (await api.run(id, signal));
  queries.setQueryData(runKey(id), run);
  if (roads === null || roads === (run.over?.roads ?? 1)) return run;
  return api.createRun(run.scenario, Object.keys(run.strategies), signal, roads > 1 ? { roads } : null);
}

export function missingText(error: Error | null): string {
  if (error === null) return "loading";
  return isNotFound(error)
    ? "no longer stored on the server"
    : error instanceof Unreachable
      ? "the server does not answer"
      : `could not be loaded: ${error.message}`;
}

/** The pinned run with its time histories. */
export async function loadPinned(
  id: string,
  roads: number | null,
  queries: QueryClient,
  signal: AbortSignal,
): Promise<Shown> {
  const run = await pinnedRun(id, roads, queries, signal);
  return fromRun(run, await historiesOf(run, queries, api.series, signal), 0, true);
}

export function usePins(): readonly PinnedRun[] {
  const queries = useQueryClient();
  const own = useStore(ownPins);
  const shared = useLab((state) => state.shared);
  const lab = useLab((state) => state.roads);
  const roads = shared ? null : lab; // a link's pins are as they were shared
  const pins: readonly Pin[] = shared ? (shared.view.pins ?? []) : own;
  return useQueries({
    queries: pins.map(({ run }) => ({
      queryKey: [...pinnedKey(run), roads],
      queryFn: ({ signal }: { readonly signal: AbortSignal }) => loadPinned(run, roads, queries, signal),
      staleTime: Infinity,
      structuralSharing: false,
    })),
    combine: (results) =>
      pins.map((pin, index): PinnedRun => {
        const { data: shown = null, error = null } = results[index] ?? {};
        return { ...pin, shown, missing: shown ? null : missingText(error), isGone: isNotFound(error) };
      }),
  });
}
