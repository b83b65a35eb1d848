/** A tuning written in the form, as a request. */

import { useMemo } from "react";
import { ask } from "../../api/http";
import { withKey } from "../../api/jobs";
import type { Scenario } from "../../api/types";
import type { Figure } from "../../server/metrics";
import { TUNING } from "../../jobs/useJob";
import { useSubmission } from "../../features/jobForm/useJobForm";
import { readDraft, tuningFieldName, type TuningDraft } from "./draft";
import type { TunableNumber } from "./space";

export function useNewTuning(
  draft: TuningDraft,
  numbers: readonly TunableNumber[],
  figures: readonly Figure[],
  scenario: Scenario | undefined,
  onSubmitted: () => void,
) {
  const parsed = useMemo(() => readDraft(draft, numbers, figures), [draft, numbers, figures]);
  return useSubmission({
    kind: "tuning",
    body: parsed.ok && scenario ? { scenario, ...parsed.body } : null,
    errors: parsed.ok ? null : parsed.errors,
    fieldNameOf: tuningFieldName,
    estimate: (body, signal) => ask("post", "/tunings", { body: { ...body, dry_run: true } }, signal),
    onSubmitted,
    submit: async (body, keyOf) => ({
      to: TUNING.page,
      params: { id: (await ask("post", "/tunings", { body, ...withKey(keyOf(body)) })).id },
    }),
  });
}
