/** A sweep written in the dialog, as a batch to order. */

import { useMemo } from "react";
import { batches } from "../api/jobs";
import type { Scenario } from "../api/types";
import { BATCH } from "../jobs/useJob";
import { useSubmission } from "../submission/useSubmission";
import { readDraft, type SweepDraft } from "./draft";
import { sweepPlaces } from "./problems";

export function useSweep(draft: SweepDraft, scenario: Scenario, onSubmitted: () => void) {
  const reading = useMemo(() => readDraft(draft), [draft]);
  return useSubmission({
    kind: "batch",
    body: reading.ok ? { scenario, strategies: draft.strategies, sweep: reading.sweep } : null,
    errors: reading.ok ? null : reading.errors,
    placeOf: sweepPlaces(draft.fields.map(({ field }) => field.name)),
    estimate: batches.estimate,
    onSubmitted,
    submit: async (body, keyOf) => ({ to: BATCH.page, params: { id: (await batches.create(body, keyOf(body))).id } }),
  });
}
