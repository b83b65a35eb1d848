/** Checks a draft, here at once and on the server when it rests; starts it once. */

import { useDebouncedValue } from "@mantine/hooks";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useMemo, useRef } from "react";
import { api, type SweepWish } from "../api/client";
import { ApiProblem } from "../api/problem";
import type { Estimate, Scenario } from "../api/types";
import { readDraft, type DraftErrors, type SweepDraft } from "./draft";
import { placeProblems } from "./problems";

const REST_MS = 350;

interface SweepState {
  readonly errors: DraftErrors;
  readonly general: readonly string[];
  readonly estimate: Estimate | undefined;
  readonly pending: boolean;
  readonly starting: boolean;
  readonly start: () => void;
}

/** 128 random bits; `crypto.randomUUID` is missing where the page is not a secure context. */
export function randomKey(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

export function useSweep(draft: SweepDraft, scenario: Scenario): SweepState {
  const reading = useMemo(() => readDraft(draft), [draft]);
  const text = reading.ok ? JSON.stringify({ scenario, strategies: draft.strategies, sweep: reading.sweep }) : "";
  const [rested] = useDebouncedValue(text, REST_MS);
  const settled = rested === text;
  const estimate = useQuery({
    queryKey: ["estimate", rested],
    queryFn: ({ signal }) => api.estimate(JSON.parse(rested) as SweepWish, signal),
    enabled: rested !== "" && settled,
    gcTime: 60_000,
  });

  // The same wish keeps its key, so that a lost answer asked for again is not a second batch.
  const keys = useRef(new Map<string, string>());
  const started = useMutation({
    mutationFn: (wish: string) => {
      const key = keys.current.get(wish) ?? randomKey();
      keys.current.set(wish, key);
      return api.createBatch(JSON.parse(wish) as SweepWish, key);
    },
    networkMode: "always",
    onSuccess: ({ id }) => window.location.assign(`/b/${encodeURIComponent(id)}`),
  });

  const problem = started.error ?? (settled ? estimate.error : null);
  const placed = useMemo(() => {
    const names = draft.fields.map(({ field }) => field.name);
    if (problem instanceof ApiProblem) return placeProblems(problem.errors, names, problem.message);
    return { fields: {}, general: problem ? [problem.message] : [] };
  }, [problem, draft.fields]);

  return {
    errors: reading.ok ? placed.fields : reading.errors,
    general: reading.ok ? placed.general : [],
    estimate: reading.ok && settled && !estimate.isError ? estimate.data : undefined,
    pending: reading.ok && (!settled || estimate.isFetching),
    // The page is left once it has started.
    starting: started.isPending || started.isSuccess,
    start: () => started.mutate(text),
  };
}
