/** What a rule base comes to, asked of the service while it is edited: one question at a time, the newest last. */

import { useQuery } from "@tanstack/react-query";
import { useEffect, useMemo, useState } from "react";
import { ask } from "../../api/http";
import { ApiProblem, isTransient, messageOf, type FieldError } from "../../api/problem";
import type { FuzzyAnswer, JsonValue } from "../../api/types";
import { useFromScenario } from "../../lab/context";
import { createLatest } from "../../lib/latest";
import { getAt } from "../../scenario/path";

export interface Inference {
  /** Of the last rule base that was none to refuse. */
  readonly answer: FuzzyAnswer;
  readonly paper: FuzzyAnswer;
  /** What is wrong with the newest. */
  readonly errors: readonly FieldError[];
}

/** `null` until the paper's is there. */
export function useInference(): Inference | null {
  const paper = useQuery({
    queryKey: ["fuzzy"],
    queryFn: ({ signal }) => ask("post", "/fuzzy", { body: {} }, signal),
    staleTime: Infinity,
  }).data;
  const fuzzy = useFromScenario((scenario) => getAt(scenario, "/fuzzy"));
  const [shown, setShown] = useState<Omit<Inference, "paper" | "answer"> & { readonly answer: FuzzyAnswer | null }>({
    answer: null,
    errors: [],
  });
  const latest = useMemo(
    () =>
      createLatest<JsonValue, FuzzyAnswer>({
        run: (asked, signal) => ask("post", "/fuzzy", { body: { scenario: { fuzzy: asked } } }, signal),
        onAnswer: (answer) => setShown({ answer, errors: [] }),
        onError: (error) => {
          if (isTransient(error)) return;
          const errors = error instanceof ApiProblem ? error.errors : [{ pointer: "", message: messageOf(error) }];
          setShown(({ answer }) => ({ answer, errors }));
        },
      }),
    [],
  );
  useEffect(() => latest.request(fuzzy ?? {}), [latest, fuzzy]);
  useEffect(() => latest.cancel, [latest]);
  return paper ? { paper, answer: shown.answer ?? paper, errors: shown.errors } : null;
}
