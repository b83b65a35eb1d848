/** From a run of a batch to the lab. */

import { useMutation } from "@tanstack/react-query";
import { api } from "../api/client";
import { explain } from "../api/problem";
import type { Batch, JsonValue, Scenario } from "../api/types";
import { setAt } from "../editor/path";
import { useOpenInLab } from "../shell/useOpenInLab";
import { pointerOf } from "../sweep/fields";

export interface RunAtValues {
  readonly run: number;
  /** The swept fields' values. */
  readonly at: Readonly<Record<string, JsonValue>>;
}

/** The scenario of a place. */
export const scenarioAt = (base: Scenario, at: RunAtValues["at"]): Scenario =>
  Object.entries(at).reduce((scenario, [name, value]) => setAt(scenario, pointerOf(name), value), base);

export interface Opening {
  readonly open: (run: RunAtValues) => void;
  /** The run being opened. */
  readonly run: number | null;
  readonly error: string | null;
}

export function useOpenRun(batch: Batch): Opening {
  const openInLab = useOpenInLab();
  const opening = useMutation({
    mutationFn: ({ at }: RunAtValues) => api.createRun(scenarioAt(batch.scenario, at), batch.strategies),
    networkMode: "always",
  });
  const { error } = opening;
  return {
    open: (run) => {
      if (!opening.isPending) opening.mutate(run, { onSuccess: openInLab() });
    },
    run: opening.isPending ? opening.variables.run : null,
    error: error && explain(error),
  };
}
