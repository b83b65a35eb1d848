/** What the shown result is compared with, for the result view. */

import { useMemo, useCallback } from "react";
import {
  queryOptions,
  useQueries,
  useQueryClient,
  type QueryClient,
  useQuery,
  type UseQueryResult,
} from "@tanstack/react-query";
import {
  type Compared,
  type Variant,
  referenceVariant,
  whyNotCompared,
  type Reference,
  type RoadPairedChanges,
} from "../../lab/compare";
import { useSelector, createAtom } from "@tanstack/react-store";
import { api } from "../../api/client";
import { isNotFound, Unreachable } from "../../api/problem";
import type { Run, PairedChanges, StrategyId } from "../../api/types";
import { useLab } from "../../lab/context";
import { historiesOf } from "../../lab/histories";
import { createPins, type Pin } from "../../lab/pins";
import { fromCache, runKey, changesQuery } from "../../server/queries";
import { fromRun, type Result, beforeEdit, isUndone, roadsOf } from "../../lab/result";
import { ownStorage, readStored, writeStored } from "../../lib/storage";
import type { PartShown } from "../../lab/resultView";

export function useCompared(): Compared {
  const before = useBefore();
  const isShown = useSelector(beforeShown);
  const pinned = usePins();
  return useMemo(() => {
    const pins = pinned.flatMap(({ name, run, shown }, index) => (shown ? [{ name, run, shown, index }] : []));
    return { before: isShown ? before : null, pins };
  }, [before, isShown, pinned]);
}

/** Those of this browser. */
export const ownPins = createPins(ownStorage());

export interface PinnedRun extends Pin {
  /** `null` until it is there. */
  readonly shown: Result | null;
  /** Why it is not shown; `null` where it is. */
  readonly missing: string | null;
  /** The server has it no more. */
  readonly isGone: boolean;
}

export const pinnedKey = (run: string) => ["pinned", run] as const;

/** The pinned run; where the lab drives another number of roads, its scenario over as many. */
async function pinnedRun(id: string, roads: number | null, queries: QueryClient, signal: AbortSignal): Promise<Run> {
  const run = await fromCache(queries, runKey(id), () => api.run(id, signal));
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
async function loadPinned(
  id: string,
  roads: number | null,
  queries: QueryClient,
  signal: AbortSignal,
): Promise<Result> {
  const run = await pinnedRun(id, roads, queries, signal);
  return fromRun(run, await historiesOf(run, queries, api.series, signal), 0, true);
}

const pinnedQuery = (run: string, roads: number | null, queries: QueryClient) =>
  queryOptions({
    queryKey: [...pinnedKey(run), roads],
    queryFn: ({ signal }) => loadPinned(run, roads, queries, signal),
    staleTime: Infinity,
    structuralSharing: false,
  });

/** The pinned variants: one's own, or those of the link that is shown; each with its result once that is there. */
export function usePins(): readonly PinnedRun[] {
  const queries = useQueryClient();
  const own = useSelector(ownPins);
  const shared = useLab((state) => state.shared);
  const lab = useLab((state) => state.roads);
  const roads = shared ? null : lab; // a link's pins are as they were shared
  const pins: readonly Pin[] = shared ? (shared.view.pins ?? []) : own;
  return useQueries({
    queries: pins.map(({ run }) => pinnedQuery(run, roads, queries)),
    combine: (results) =>
      pins.map((pin, index): PinnedRun => {
        const { data: shown = null, error = null } = results[index] ?? {};
        return { ...pin, shown, missing: shown ? null : missingText(error), isGone: isNotFound(error) };
      }),
  });
}

const NAME = "ridelab-before";

export const beforeShown = createAtom(readStored(NAME) !== false);

export function showBefore(isShown: boolean): void {
  beforeShown.set(isShown);
  writeStored(NAME, isShown ? null : false);
}

export const [BEFORE_EDIT, BEFORE_UNDO] = ["before the last edit", "before the undo"];

/** Where the lab drives another number of roads by now, over as many. */
export function useBefore(): Variant | null {
  const queries = useQueryClient();
  const before = useLab(beforeEdit);
  const history = useLab((state) => state.history);
  const roads = useLab((state) => state.roads);
  const isShown = useSelector(beforeShown);
  const id = before?.runId ?? "";
  const isUnlike = before !== null && roadsOf(before) !== roads;
  const { data } = useQuery({ ...pinnedQuery(id, roads, queries), enabled: isShown && isUnlike && id !== "" });
  const shown = isUnlike ? (data ?? before) : before;
  const name = useMemo(() => (before && isUndone(before, history) ? BEFORE_UNDO : BEFORE_EDIT), [before, history]);
  return useMemo(() => shown && { name, shown }, [name, shown]);
}

interface View {
  readonly baseline: StrategyId | null;
  readonly reference: Reference;
}

/** What a result's changes are to be asked against; `null` where it has them itself, or there are none. */
function refersTo({ over, runId, summaries }: Result, variant: Result | null, baseline: string | null) {
  if (over === null || runId === null) return null;
  if (variant) return variant.runId === null || variant.runId === runId ? null : { against: variant.runId };
  return baseline === null || baseline === over.baseline || !(baseline in summaries) ? null : { baseline };
}

/** What each run over several roads changes against what changes are against, paired by road. */
export function usePaired(
  part: PartShown | null,
  compared: Compared,
  { baseline, reference }: View,
): RoadPairedChanges {
  const variant = referenceVariant(compared, reference)?.shown ?? null;
  const shown = part?.shown;
  const asked = useMemo(() => {
    const results = shown ? [shown, ...compared.pins.map((pin) => pin.shown)] : [];
    const questions = results.flatMap((result) => {
      const question = variant && whyNotCompared(result, variant) !== null ? null : refersTo(result, variant, baseline);
      return question ? [[result.runId ?? "", question] as const] : [];
    });
    return [...new Map(questions)];
  }, [shown, compared.pins, variant, baseline]);
  return useQueries({
    queries: asked.map(([run, question]) => changesQuery(run, question)),
    combine: useCallback(
      (results: readonly UseQueryResult<PairedChanges>[]): RoadPairedChanges =>
        Object.fromEntries(
          asked.flatMap(([run], index) => {
            const result = results[index];
            // One that could not be had has no changes.
            return result?.data || result?.isError ? [[run, result.data?.changes ?? {}]] : [];
          }),
        ),
      [asked],
    ),
  });
}
