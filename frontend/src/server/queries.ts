/** Everything the page reads through TanStack Query, with its keys. */

import { queryOptions, QueryClient } from "@tanstack/react-query";
import { api } from "../api/client";
import { ask, query } from "../api/http";
import { ApiProblem, isTransient } from "../api/problem";
import type { FigureTemplates, Requirement, Strategy, StrategyId } from "../api/types";
import { readSchema } from "../scenario/schema";

/** Samples per strategy that cover a screen: half of them on and around the bump. */
export const OVERVIEW_POINTS = 440;
/** Samples per strategy once somebody zooms in: finer than a screen at any stage of a usual run. */
export const DETAIL_POINTS = 8_000;

/** The most that the service gives of a strategy: all samples of a run of up to 100 s. */
export const ALL_POINTS = 100_000;

const FOR_EVER = { staleTime: Infinity, gcTime: Infinity } as const;
/** Asked for until the server is there. */
export const RETRIED = { retry: (_count: number, error: Error) => isTransient(error), retryDelay: 1000 } as const;
/** What pages cannot do without. */
const INDISPENSABLE = { ...FOR_EVER, ...RETRIED } as const;

export const schemaQuery = queryOptions({
  queryKey: ["schema"],
  queryFn: async ({ signal }) => readSchema(await ask("get", "/schema", {}, signal)),
  ...INDISPENSABLE,
});
export const presetsQuery = { ...query("/presets", {}), ...INDISPENSABLE };
/** Heights of a measured road that its picture has. */
const ROAD_POINTS = 600;
/** A measured road; only what is said of its first file may come later. */
export const roadQuery = (id: string) => ({
  ...query("/roads/{id}", { path: { id }, query: { points: ROAD_POINTS } }),
  enabled: id !== "",
  ...FOR_EVER,
});
/** Looked at again after a minute: somebody may have installed what was missing. */
export const vehiclesQuery = { ...query("/vehicles", {}), ...FOR_EVER };
const LOOK_MS = 2000;
/** What there is, and of which file: another text where a file was saved, and what follows from it is read again. */
export const lawsOf = (strategies: readonly Strategy[]) =>
  strategies.map(({ id, source }) => `${id} ${source?.digest ?? ""}`).join();
/** Those of one's own change when their file is saved: while there are any, the page looks for that. */
export const strategiesQuery = queryOptions({
  queryKey: ["strategies"],
  queryFn: async ({ signal, client }) => {
    const now = await ask("get", "/strategies", {}, signal);
    const catalogue = client.getQueryData<readonly Strategy[]>(["strategies"]);
    if (catalogue && lawsOf(catalogue) !== lawsOf(now))
      for (const { queryKey } of [schemaQuery, figuresQuery]) void client.invalidateQueries({ queryKey });
    return now;
  },
  ...INDISPENSABLE,
  refetchInterval: ({ state }: { readonly state: { readonly data?: readonly Strategy[] | undefined } }) =>
    state.data?.some(({ own }) => own) ? LOOK_MS : (false as const),
});
/** What a robustness study varies, while nobody says otherwise. */
export const uncertaintiesQuery = { ...query("/robustness", {}), ...INDISPENSABLE };
export const catalogueQuery = { ...query("/catalogue", {}), ...INDISPENSABLE };
export const figuresQuery = queryOptions({
  queryKey: ["figures"],
  // plotly's own JSON, which the API's description leaves open
  queryFn: async ({ signal }) => (await ask("get", "/figures", {}, signal)).figures as unknown as FigureTemplates,
  ...INDISPENSABLE,
});

/** From the cache, else fetched under the caller's own signal and put there: whoever asks for something else stops it. */
export async function fromCache<T>(queries: QueryClient, key: readonly unknown[], fetch: () => Promise<T>): Promise<T> {
  const data = queries.getQueryData<T>(key) ?? (await fetch());
  queries.setQueryData<T>(key, data);
  return data;
}

export const runKey = (id: string) => ["run", id] as const;

/** A shared result; it never changes, apart from the version of the server that shows it. */
export const linkKey = (slug: string) => ["link", slug] as const;

export const seriesKey = (id: string, strategies: readonly StrategyId[], points: number) =>
  ["series", id, points, strategies] as const;

/** What a run over several roads changes, paired by road: against another run, or one of its strategies. */
export const changesQuery = (
  id: string,
  refersTo: { readonly against: string } | { readonly baseline: StrategyId },
) => ({ ...query("/runs/{id}/changes", { path: { id }, query: refersTo }), staleTime: Infinity });

/** What a run's strategies mean beside each other, against one of them; a run never changes. */
export const comparisonQuery = (id: string, question: { readonly baseline: StrategyId; readonly compare: string }) =>
  queryOptions({
    queryKey: ["comparison", id, question],
    queryFn: async ({ signal }) =>
      (await ask("get", "/runs/{id}", { path: { id }, query: question }, signal)).comparison,
    staleTime: Infinity,
  });

/** How a run keeps requirements. */
export const judgedQuery = (id: string, requirements: readonly Requirement[], baseline: StrategyId | null) =>
  queryOptions({
    queryKey: ["judged", id, requirements, baseline],
    queryFn: async ({ signal }) => {
      const question = { path: { id }, query: { requirements: JSON.stringify(requirements), baseline } };
      return (await ask("get", "/runs/{id}", question, signal)).requirement_results ?? [];
    },
    staleTime: Infinity,
  });

/** Time histories of a run, with signals means and extremes of these over its roads; runs are immutable, so an answer never grows stale. */
export function seriesQuery(
  id: string,
  strategies: readonly StrategyId[],
  points: number,
  overRoads: readonly string[] | null = null,
) {
  return queryOptions({
    queryKey: [...seriesKey(id, strategies, points), ...(overRoads ?? [])],
    queryFn: ({ signal }) =>
      overRoads ? api.bands(id, strategies, overRoads, points, signal) : api.series(id, strategies, points, signal),
    staleTime: Infinity,
    gcTime: 5 * 60_000,
  });
}

/** Every sample of some signals of a run, or of their means over its roads; far more than a screen shows, so it is not kept for long. */
export function allSamplesQuery(
  id: string,
  strategies: readonly StrategyId[],
  signals: readonly string[],
  overRoads: boolean,
) {
  return queryOptions({
    queryKey: ["all samples", id, strategies, signals, overRoads],
    queryFn: ({ signal }) =>
      overRoads
        ? api.bands(id, strategies, signals, ALL_POINTS, signal)
        : api.series(id, strategies, ALL_POINTS, signal, signals),
    staleTime: Infinity,
    gcTime: 30_000,
  });
}

// A local server needs no network, and asking again is the connection banner's work.
const networkMode = "always";

/** What is sent was refused before anything was done with it: it waits as long as the server says and is sent again. */
const inTurn = {
  retry: (count: number, error: Error) => count < 5 && waitOf(error) !== null,
  retryDelay: (_count: number, error: Error) => 1000 * (waitOf(error) ?? 0),
};
const waitOf = (error: Error) => (error instanceof ApiProblem && isTransient(error) ? error.retryAfter : null);

/** How the page asks for data and sends changes. */
export const createQueryClient = () =>
  new QueryClient({
    defaultOptions: {
      queries: { retry: false, networkMode, refetchOnWindowFocus: false },
      mutations: { ...inTurn, networkMode },
    },
  });
