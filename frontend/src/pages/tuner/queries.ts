/** A tuning's trials. */

import { keepPreviousData, queryOptions } from "@tanstack/react-query";
import { ask } from "../../api/http";
import type { Tuning } from "../../api/types";

/** Every trial so far: asked for anew with every generation. */
export const trialsQuery = (tuning: Tuning) =>
  queryOptions({
    queryKey: ["tuning trials", tuning.id, tuning.trials.done + tuning.trials.failed],
    queryFn: ({ signal }) => ask("get", "/tunings/{id}/trials", { path: { id: tuning.id } }, signal),
    staleTime: Infinity,
    gcTime: 60_000,
    placeholderData: keepPreviousData,
  });
