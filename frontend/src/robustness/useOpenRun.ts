/** From a place of a study to its run in the lab. */

import { useMutation } from "@tanstack/react-query";
import { api } from "../api/client";
import { ApiProblem } from "../api/problem";
import type { Batch, JsonValue, Scenario } from "../api/types";
import { setAt } from "../editor/path";
import { pointerOf } from "../sweep/fields";
import type { Place } from "./summary";

/** The scenario of a place. */
export const scenarioAt = (base: Scenario, at: Readonly<Record<string, JsonValue>>): Scenario =>
  Object.entries(at).reduce((scenario, [name, value]) => setAt(scenario, pointerOf(name), value), base);

export interface Opening {
  readonly open: (place: Pick<Place, "run" | "at">) => void;
  /** The run being opened. */
  readonly run: number | null;
  readonly error: string | null;
}

export function useOpenRun(batch: Batch): Opening {
  const opening = useMutation({
    mutationFn: ({ at }: Pick<Place, "run" | "at">) => api.createRun(scenarioAt(batch.scenario, at), batch.strategies),
    networkMode: "always",
    onSuccess: ({ id }) => window.location.assign(`/r/${encodeURIComponent(id)}`),
  });
  const { error } = opening;
  return {
    open: (place) => {
      if (!opening.isPending) opening.mutate(place);
    },
    run: opening.isPending || opening.isSuccess ? opening.variables.run : null,
    error: error === null ? null : error instanceof ApiProblem && error.errors[0] ? error.errors[0].message : error.message,
  };
}
