/** Checks a study, here at once and on the server when it rests; starts it once. */

import { useDebouncedValue } from "@mantine/hooks";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useMemo, useRef } from "react";
import { api } from "../api/client";
import { ApiProblem } from "../api/problem";
import type { Estimate, Scenario } from "../api/types";
import type { DraftErrors } from "../sweep/draft";
import { placeProblems } from "../sweep/problems";
import { randomKey } from "../sweep/useSweep";
import { readStudy, type StudyDraft } from "./study";

const REST_MS = 350;

interface StudyState {
  readonly errors: DraftErrors;
  readonly general: readonly string[];
  readonly estimate: Estimate | undefined;
  readonly pending: boolean;
  readonly starting: boolean;
  readonly start: () => void;
}

export const studyAddress = (id: string, oneByOne: string | null) =>
  `/robustness/${encodeURIComponent(id)}${oneByOne === null ? "" : `?${new URLSearchParams({ one: oneByOne })}`}`;

export function useStudy(draft: StudyDraft, scenario: Scenario | undefined): StudyState {
  const reading = useMemo(() => readStudy(draft), [draft]);
  const wish = useMemo(
    () => (reading.ok && scenario ? { scenario, strategies: draft.strategies, sweep: reading.sweeps.cube } : null),
    [reading, scenario, draft.strategies],
  );
  const [rested] = useDebouncedValue(wish, REST_MS);
  const settled = rested === wish;
  const estimate = useQuery({
    queryKey: ["estimate", JSON.stringify(rested)],
    queryFn: ({ signal }) => (rested ? api.estimate(rested, signal) : Promise.reject(new Error("nothing to estimate"))),
    enabled: rested !== null && settled,
    gcTime: 60_000,
  });

  // The same wish keeps its key, so that a lost answer asked for again is not a second batch.
  const keys = useRef(new Map<string, string>());
  const submit = (asked: NonNullable<typeof wish>) => {
    const text = JSON.stringify(asked);
    const key = keys.current.get(text) ?? randomKey();
    keys.current.set(text, key);
    return api.createBatch(asked, key);
  };
  const started = useMutation({
    mutationFn: async (asked: NonNullable<typeof wish>) => {
      const oneByOne = reading.ok ? reading.sweeps.oneByOne : null;
      const alone = oneByOne && (await submit({ ...asked, sweep: oneByOne }));
      const cube = await submit(asked);
      return studyAddress(cube.id, alone?.id ?? null);
    },
    networkMode: "always",
    onSuccess: (address) => window.location.assign(address),
  });

  const problem = started.error ?? (settled ? estimate.error : null);
  const placed = useMemo(() => {
    const names = draft.ranges.map(({ field }) => field.name);
    if (problem instanceof ApiProblem) return placeProblems(problem.errors, names, problem.message);
    return { fields: {}, general: problem ? [problem.message] : [] };
  }, [problem, draft.ranges]);

  return {
    errors: reading.ok ? placed.fields : reading.errors,
    general: reading.ok ? placed.general : [],
    estimate: wish && settled && !estimate.isError ? estimate.data : undefined,
    pending: wish !== null && (!settled || estimate.isFetching),
    starting: started.isPending || started.isSuccess,
    start: () => wish && started.mutate(wish),
  };
}
