/** How the shown result, under a moving slider too, and those it is compared with keep the requirements. */

import { useQueries, type UseQueryResult } from "@tanstack/react-query";
import { useCallback, useMemo } from "react";
import type { StrategyId } from "../../api/types";
import type { Compared } from "../../lab/compare";
import type { Judged, Requirement, RequirementResult } from "../../lab/requirements";
import type { PartShown } from "../../lab/resultView";
import { judgedHere } from "./judged";
import { judgedQuery } from "../../server/queries";

export function useJudged(
  part: PartShown | null,
  { pins }: Compared,
  requirements: readonly Requirement[],
  baseline: StrategyId,
): Judged {
  const shown = part?.shown;
  const asked = useMemo(() => {
    const results = shown && requirements.length > 0 ? [shown, ...pins.map((pin) => pin.shown)] : [];
    const runs = results.flatMap(({ runId, summaries }) =>
      runId === null ? [] : [[runId, baseline in summaries ? baseline : null] as const],
    );
    return [...new Map(runs)];
  }, [shown, pins, requirements, baseline]);
  const here = useMemo(
    () =>
      shown?.over === null && requirements.length > 0
        ? { [shown.runId ?? ""]: judgedHere(shown.summaries, requirements, baseline) }
        : {},
    [shown, requirements, baseline],
  );
  const stored = useQueries({
    queries: asked.map(([run, base]) => judgedQuery(run, requirements, base)),
    combine: useCallback(
      (results: readonly UseQueryResult<readonly RequirementResult[]>[]): Judged =>
        Object.fromEntries(
          asked.flatMap(([run], index) => {
            const data = results[index]?.data;
            return data === undefined ? [] : [[run, data]];
          }),
        ),
      [asked],
    ),
  });
  return useMemo(() => ({ ...here, ...stored }), [here, stored]);
}
