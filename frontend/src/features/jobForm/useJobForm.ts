/** What is ordered by a form: checked on the server when the form rests, begun once. */

import { useDebouncedValue } from "@mantine/hooks";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useRouter, type NavigateOptions } from "@tanstack/react-router";
import { useRef } from "react";
import { ApiProblem } from "../../api/problem";
import { navigateIfStillHere } from "../../ui/openInLab";
import { problemsByField, type DraftErrors, type FieldNameOf } from "./problems";

const REST_MS = 350;

interface JobFormOptions<Body, Estimate> {
  readonly kind: string;
  /** What the form asks for; null while there is nothing to ask for yet. */
  readonly body: Body | null;
  /** What the form itself finds wrong; null when nothing is. */
  readonly errors: DraftErrors | null;
  readonly fieldNameOf: FieldNameOf;
  readonly estimate: (body: Body, signal: AbortSignal) => Promise<Estimate>;
  /** Begins it and says where it can be seen. What is sent carries its `keyOf`. */
  readonly submit: (body: Body, keyOf: (sent: unknown) => string) => Promise<NavigateOptions>;
  /** Of the form as it was when it was started, also where the reader has gone to another page meanwhile. */
  readonly onSubmitted: () => void;
}

type Started<Body> = { readonly body: Body } & Pick<JobFormOptions<Body, unknown>, "onSubmitted">;

export interface JobFormState<Estimate> {
  readonly errors: DraftErrors;
  readonly general: readonly string[];
  readonly estimate: Estimate | undefined;
  readonly pending: boolean;
  readonly starting: boolean;
  /** Begins it, where an estimate says that it can be and it has not begun. */
  readonly start: () => void;
}

/** 128 random bits; `crypto.randomUUID` is missing where the page is not a secure context. */
function randomKey(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

export function useJobForm<Body, Estimate>(submission: JobFormOptions<Body, Estimate>): JobFormState<Estimate> {
  const text = submission.body === null ? "" : JSON.stringify(submission.body);
  const [debouncedText] = useDebouncedValue(text, REST_MS);
  const isUpToDate = debouncedText === text;
  const estimate = useQuery({
    queryKey: ["estimate", submission.kind, debouncedText],
    queryFn: ({ signal }) => submission.estimate(JSON.parse(debouncedText) as Body, signal),
    enabled: debouncedText !== "" && isUpToDate,
    gcTime: 60_000,
  });

  // What is sent again keeps its key, so that a lost answer asked for again does not begin a second one.
  const keys = useRef(new Map<string, string>());
  const keyOf = (sent: unknown) => {
    const name = JSON.stringify(sent);
    const key = keys.current.get(name) ?? randomKey();
    keys.current.set(name, key);
    return key;
  };
  const router = useRouter();
  const started = useMutation({
    mutationFn: ({ body }: Started<Body>) => submission.submit(body, keyOf),
    onSuccess: (_, { onSubmitted }) => onSubmitted(),
  });

  const problem = started.error ?? (isUpToDate ? estimate.error : null);
  const placed =
    problem instanceof ApiProblem
      ? problemsByField(problem.errors, submission.fieldNameOf, problem.message)
      : { fields: {}, general: problem ? [problem.message] : [] };

  const shown = text && isUpToDate && !estimate.isError ? estimate.data : undefined;
  return {
    errors: submission.errors ?? placed.fields,
    general: submission.errors ? [] : placed.general,
    estimate: shown,
    pending: text !== "" && (!isUpToDate || estimate.isFetching),
    starting: started.isPending,
    start: () => {
      const { body, onSubmitted } = submission;
      if (body !== null && shown !== undefined && !started.isPending)
        started.mutate({ body, onSubmitted }, { onSuccess: navigateIfStillHere(router).go });
    },
  };
}
