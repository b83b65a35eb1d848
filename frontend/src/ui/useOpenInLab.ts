/** From another page to a run in the lab, which leads back to that page. */

import { useMutation } from "@tanstack/react-query";
import { useRouter } from "@tanstack/react-router";
import { useCallback } from "react";
import { explain } from "../api/problem";
import { fromHere } from "../lib/navigateIfStillHere";

interface Run {
  readonly id: string;
}

/** To be called at the click, and what it returns with the run. */
export function useOpenInLab(): () => (run: Run) => void {
  const router = useRouter();
  return useCallback(() => {
    const { href, go } = fromHere(router);
    return ({ id }) => go({ to: "/r/$id", params: { id }, search: { from: href } });
  }, [router]);
}

export interface RunInLab<What> {
  readonly open: (what: What) => void;
  /** What is being run. */
  readonly opening: What | null;
  readonly error: string | null;
}

/** Runs something first; one thing at a time. */
export function useRunInLab<What>(run: (what: What) => Promise<Run>): RunInLab<What> {
  const openInLab = useOpenInLab();
  const { mutate, isPending, variables, error } = useMutation({ mutationFn: run });
  return {
    open: (what) => {
      if (!isPending) mutate(what, { onSuccess: openInLab() });
    },
    opening: isPending ? variables : null,
    error: error && explain(error),
  };
}
