/** The run this page shows: LV in the simulation, LV in the ECU and the LQR over one scenario. */

import { keepPreviousData, queryOptions, useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { useEffect, useRef } from "react";
import { api } from "../../api/client";
import type { Run, Scenario } from "../../api/types";
import type { PageScenario } from "../../features/scenarioSource/scenarioSource";
import { runKey } from "../../server/queries";

export const STRATEGIES = ["lv", "lv_hil", "lqr"] as const;

const ecuRunQuery = (scenario: Scenario | undefined) =>
  queryOptions({
    queryKey: ["ecu run", scenario ?? null],
    queryFn: ({ signal }) => api.createRun(scenario ?? {}, STRATEGIES, signal),
    enabled: scenario !== undefined,
    staleTime: Infinity,
  });

export interface EcuRun {
  readonly scenario: Scenario | undefined;
  readonly run: Run | undefined;
  /** What is shown is older than what was asked for. */
  readonly stale: boolean;
  readonly busy: boolean;
  readonly error: Error | null;
  /** Runs the changed scenario; the page's address follows. */
  readonly change: (scenario: Scenario) => void;
  /** Another scenario altogether. */
  readonly choose: PageScenario["choose"];
}

export function useEcuRun({ scenario: stored, choose }: PageScenario): EcuRun {
  const queries = useQueryClient();
  const newest = useRef<AbortController>(null);
  const drop = () => newest.current?.abort();
  // After the page is left, an answer chooses nothing.
  useEffect(() => drop, []);
  const changed = useMutation({
    mutationFn: (scenario: Scenario) => {
      drop();
      newest.current = new AbortController();
      return api.createRun(scenario, STRATEGIES, newest.current.signal);
    },
    onSuccess: (run) => {
      queries.setQueryData(runKey(run.id), run);
      queries.setQueryData(ecuRunQuery(run.scenario).queryKey, run);
      choose({ run: run.id });
    },
  });
  // Until the server has taken an edit, the form shows it over the stored one.
  const edited = changed.isPending || changed.isError ? changed.variables : undefined;
  const shown = useQuery({ ...ecuRunQuery(stored), placeholderData: keepPreviousData });
  return {
    scenario: edited ?? stored,
    run: shown.data,
    stale: shown.isPlaceholderData || changed.isPending,
    busy: shown.isFetching || changed.isPending,
    error: changed.error ?? shown.error,
    change: (scenario) => changed.mutate(scenario),
    choose: (origin) => {
      drop();
      changed.reset();
      choose(origin);
    },
  };
}
