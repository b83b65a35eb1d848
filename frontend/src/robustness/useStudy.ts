/** A study written in the form, as batches to order: the cube, and each quantity alone where that is asked for. */

import { useMemo } from "react";
import { batches } from "../api/jobs";
import type { Scenario } from "../api/types";
import { useOrder } from "../order/useOrder";
import { sweepPlaces } from "../sweep/problems";
import { readStudy, type StudyDraft } from "./study";

export const studyAddress = (id: string, oneByOne: string | null) =>
  `/robustness/${encodeURIComponent(id)}${oneByOne === null ? "" : `?${new URLSearchParams({ one: oneByOne })}`}`;

export function useStudy(draft: StudyDraft, scenario: Scenario | undefined) {
  const reading = useMemo(() => readStudy(draft), [draft]);
  return useOrder({
    kind: "batch",
    wish: reading.ok && scenario ? { scenario, strategies: draft.strategies, sweep: reading.sweeps.cube, label: "Robustness study" } : null,
    errors: reading.ok ? null : reading.errors,
    placeOf: sweepPlaces(draft.ranges.map(({ field }) => field.name)),
    estimate: batches.estimate,
    begin: async (wish, keyOf) => {
      const submit = (sent: typeof wish) => batches.create(sent, keyOf(sent));
      const oneByOne = reading.ok ? reading.sweeps.oneByOne : null;
      const alone = oneByOne && (await submit({ ...wish, sweep: oneByOne, label: "Robustness study: each field alone" }));
      return studyAddress((await submit(wish)).id, alone?.id ?? null);
    },
  });
}
