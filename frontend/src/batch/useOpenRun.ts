/** From a run of a batch to the lab. */

import { useMutation } from "@tanstack/react-query";
import { api } from "../api/client";
import { explain } from "../api/problem";
import type { Batch, JsonValue, Scenario } from "../api/types";
import { setAt } from "../editor/path";
import { useOpenInLab } from "../shell/useOpenInLab";
import { pointerOf } from "../sweep/fields";

export interface Place {
  readonly run: number;
  /** The swept fields' values. */
  readonly at: Readonly<Record<string, JsonValue>>;
}

/** The scenario of a place. */
export const scenarioAt = (base: Scenario, at: Place["at"]): Scenario =>
  Object.entries(at).reduce((scenario, [name, value]) => setAt(scenario, pointerOf(name), value), base);

export interface Opening {
  readonly open: (place: Place) => void;
  /** The run being opened. */
  readonly run: number | null;
  readonly error: string | null;
}

export function useOpenRun(batch: Batch): Opening {
  const openInLab = useOpenInLab();
  const opening = useMutation({
    mutationFn: ({ at }: Place) => api.createRun(scenarioAt(batch.scenario, at), batch.strategies),
    networkMode: "always",
  });
  const { error } = opening;
  return {
    open: (place) => {
      if (!opening.isPending) opening.mutate(place, { onSuccess: openInLab() });
    },
    run: opening.isPending ? opening.variables.run : null,
    error: error && explain(error),
  };
}
