/** Checks a draft, here at once and on the server when it rests; starts it once. */

import { useDebouncedValue } from "@mantine/hooks";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useMemo, useRef } from "react";
import { api, type TuningWish } from "../api/client";
import { ApiProblem } from "../api/problem";
import type { Scenario, TuningEstimate } from "../api/types";
import type { Figure } from "../batch/figures";
import { randomKey } from "../sweep/useSweep";
import { readDraft, type DraftErrors, type TuningDraft } from "./draft";
import { placeProblems } from "./problems";

const REST_MS = 350;

interface NewTuning {
  readonly errors: DraftErrors;
  readonly general: readonly string[];
  readonly estimate: TuningEstimate | undefined;
  readonly pending: boolean;
  readonly starting: boolean;
  readonly start: () => void;
}

export function useNewTuning(draft: TuningDraft, figures: readonly Figure[], scenario: Scenario | undefined): NewTuning {
  const reading = useMemo(() => readDraft(draft, figures), [draft, figures]);
  const text = reading.ok && scenario ? JSON.stringify({ scenario, ...reading.wish }) : "";
  const [rested] = useDebouncedValue(text, REST_MS);
  const settled = rested === text;
  const estimate = useQuery({
    queryKey: ["tuning estimate", rested],
    queryFn: ({ signal }) => api.estimateTuning(JSON.parse(rested) as TuningWish, signal),
    enabled: rested !== "" && settled,
    gcTime: 60_000,
  });

  // The same wish keeps its key, so that a lost answer asked for again is not a second tuning.
  const keys = useRef(new Map<string, string>());
  const started = useMutation({
    mutationFn: (wish: string) => {
      const key = keys.current.get(wish) ?? randomKey();
      keys.current.set(wish, key);
      return api.createTuning(JSON.parse(wish) as TuningWish, key);
    },
    networkMode: "always",
    onSuccess: ({ id }) => window.location.assign(`/tuner/${encodeURIComponent(id)}`),
  });

  const problem = started.error ?? (settled ? estimate.error : null);
  const placed = useMemo(() => {
    if (problem instanceof ApiProblem) return placeProblems(problem.errors, problem.message);
    return { fields: {}, general: problem ? [problem.message] : [] };
  }, [problem]);

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
