/** Opens a set of weights in the lab: the tuning's scenario with them in it. */

import { useMutation } from "@tanstack/react-query";
import { api } from "../api/client";
import type { Trial, Tuning } from "../api/types";
import { useOpenInLab } from "../shell/useOpenInLab";
import { withWeights } from "./space";

/** What the weights are looked at beside. */
const BESIDE = ["lqr", "passive"];

export interface Load {
  readonly load: (trial: Trial) => void;
  /** The trial that is on its way. */
  readonly loading: number | null;
  readonly error: Error | null;
}

export function useLoad({ scenario, strategy }: Tuning): Load {
  const openInLab = useOpenInLab();
  const opening = useMutation({
    mutationFn: ({ weights }: Trial) => api.createRun(withWeights(scenario, weights), [...new Set([strategy, ...BESIDE])]),
    networkMode: "always",
  });
  return {
    load: (trial) => {
      if (!opening.isPending) opening.mutate(trial, { onSuccess: openInLab() });
    },
    loading: opening.isPending ? opening.variables.number : null,
    error: opening.error,
  };
}
