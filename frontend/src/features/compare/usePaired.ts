/** What each run over several roads changes against what changes are against, paired by road. */

import { useQueries, type UseQueryResult } from "@tanstack/react-query";
import { useCallback, useMemo } from "react";
import type { PairedChanges } from "../../api/types";
import { againstOf, whyNotCompared, type Against, type Compared, type Paired } from "../../lab/compare";
import { changesQuery } from "../../server/queries";
import { baselineOf, type PartShown } from "../../lab/resultView";
import type { Shown } from "../../lab/result";

interface View {
  readonly baseline: string;
  readonly against: Against;
}

/** What a result's changes are to be asked against; `null` where it has them itself, or there are none. */
function refersTo({ over, runId, summaries }: Shown, variant: Shown | null, baseline: string | null) {
  if (over === null || runId === null) return null;
  if (variant) return variant.runId === null || variant.runId === runId ? null : { against: variant.runId };
  return baseline === null || baseline === over.baseline || !(baseline in summaries) ? null : { baseline };
}

export function usePaired(part: PartShown | null, compared: Compared, view: View): Paired {
  const variant = againstOf(compared, view.against)?.shown ?? null;
  const baseline = part && baselineOf(part, view.baseline);
  const shown = part?.shown;
  const asked = useMemo(() => {
    const results = shown ? [shown, ...compared.pins.map((pin) => pin.shown)] : [];
    const questions = results.flatMap((result) => {
      const question = variant && whyNotCompared(result, variant) !== null ? null : refersTo(result, variant, baseline);
      return question ? [[result.runId ?? "", question] as const] : [];
    });
    return [...new Map(questions)];
  }, [shown, compared.pins, variant, baseline]);
  return useQueries({
    queries: asked.map(([run, question]) => changesQuery(run, question)),
    combine: useCallback(
      (results: readonly UseQueryResult<PairedChanges>[]): Paired =>
        Object.fromEntries(
          asked.flatMap(([run], index) => {
            const result = results[index];
            // One that could not be had has no changes.
            return result?.data || result?.isError ? [[run, result.data?.changes ?? {}]] : [];
          }),
        ),
      [asked],
    ),
  });
}
