/** A study written in the form, as batches to submit: the cube and, on request, each field alone. */

import { useMemo } from "react";
import { batches } from "../api/jobs";
import type { Scenario } from "../api/types";
import { STUDY_LABEL } from "../jobs/study";
import { useSubmission } from "../submission/useSubmission";
import { sweepPlaces } from "../sweep/problems";
import { readStudy, type StudyDraft } from "./study";

export function useStudy(draft: StudyDraft, scenario: Scenario | undefined, onSubmitted: () => void) {
  const reading = useMemo(() => readStudy(draft), [draft]);
  return useSubmission({
    kind: "batch",
    body: reading.ok && scenario ? { scenario, strategies: draft.strategies, sweep: reading.sweeps.cube, label: STUDY_LABEL } : null,
    errors: reading.ok ? null : reading.errors,
    placeOf: sweepPlaces(draft.ranges.map(({ field }) => field.name)),
    estimate: batches.estimate,
    onSubmitted,
    submit: async (body, keyOf) => {
      const submit = (sent: typeof body) => batches.create(sent, keyOf(sent));
      const oneByOne = reading.ok ? reading.sweeps.oneByOne : null;
      const alone = oneByOne && (await submit({ ...body, sweep: oneByOne, label: `${STUDY_LABEL}: each field alone` }));
      return { to: "/robustness/$id", params: { id: (await submit(body)).id }, search: alone ? { one: alone.id } : {} };
    },
  });
}
