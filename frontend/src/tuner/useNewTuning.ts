/** A tuning written in the form, as one to order. */

import { useMemo } from "react";
import { api } from "../api/client";
import type { Scenario } from "../api/types";
import type { Figure } from "../batch/figures";
import { useOrder } from "../order/useOrder";
import { readDraft, tuningPlace, type TuningDraft } from "./draft";

export function useNewTuning(draft: TuningDraft, figures: readonly Figure[], scenario: Scenario | undefined) {
  const reading = useMemo(() => readDraft(draft, figures), [draft, figures]);
  return useOrder({
    kind: "tuning",
    wish: reading.ok && scenario ? { scenario, ...reading.wish } : null,
    errors: reading.ok ? null : reading.errors,
    placeOf: tuningPlace,
    estimate: api.estimateTuning,
    begin: async (wish, keyOf) => `/tuner/${encodeURIComponent((await api.createTuning(wish, keyOf(wish))).id)}`,
  });
}
