/** A study written in the form, as batches to submit: the cube and, on request, each field alone. */

import { useMemo } from "react";
import { ask } from "../../api/http";
import { withKey } from "../../api/jobs";
import type { Scenario } from "../../api/types";
import { STUDY_LABEL } from "../../features/sweep/study";
import { useSubmission } from "../../features/jobForm/useJobForm";
import { sweepFieldName } from "../../features/sweep/problems";
import { readStudy, type StudyDraft } from "./study";

export function useStudy(draft: StudyDraft, scenario: Scenario | undefined, onSubmitted: () => void) {
  const parsed = useMemo(() => readStudy(draft), [draft]);
  return useSubmission({
    kind: "batch",
    body:
      parsed.ok && scenario
        ? { scenario, strategies: draft.strategies, sweep: parsed.sweeps.cube, label: STUDY_LABEL }
        : null,
    errors: parsed.ok ? null : parsed.errors,
    fieldNameOf: sweepFieldName(draft.ranges.map(({ field }) => field.name)),
    estimate: (body, signal) => ask("post", "/batches", { body: { ...body, dry_run: true } }, signal),
    onSubmitted,
    submit: async (body, keyOf) => {
      const submit = (sent: typeof body) => ask("post", "/batches", { body: sent, ...withKey(keyOf(sent)) });
      const oneByOne = parsed.ok ? parsed.sweeps.oneByOne : null;
      const alone = oneByOne && (await submit({ ...body, sweep: oneByOne, label: `${STUDY_LABEL}: each field alone` }));
      return { to: "/robustness/$id", params: { id: (await submit(body)).id }, search: alone ? { one: alone.id } : {} };
    },
  });
}
