/** A tuning written in the form, as one to order. */

import { useMemo } from "react";
import { tunings } from "../api/jobs";
import type { Scenario } from "../api/types";
import type { Figure } from "../batch/figures";
import { TUNING } from "../jobs/useJob";
import { useOrder } from "../order/useOrder";
import { readDraft, tuningPlace, type TuningDraft } from "./draft";

export function useNewTuning(draft: TuningDraft, figures: readonly Figure[], scenario: Scenario | undefined) {
  const reading = useMemo(() => readDraft(draft, figures), [draft, figures]);
  return useOrder({
    kind: "tuning",
    wish: reading.ok && scenario ? { scenario, ...reading.wish } : null,
    errors: reading.ok ? null : reading.errors,
    placeOf: tuningPlace,
    estimate: tunings.estimate,
    begin: async (wish, keyOf) => TUNING.address((await tunings.create(wish, keyOf(wish))).id),
  });
}
