/** What each run over several roads changes against the variant chosen, paired by road. */

import { useQueries, type UseQueryResult } from "@tanstack/react-query";
import { useCallback, useMemo } from "react";
import type { PairedChanges } from "../api/types";
import { whyNotCompared, type Compared, type Variant } from "../state/compare";
import { changesQuery } from "../state/queries";
import { roadsOf, type Shown } from "../state/shown";

/** One that could not be had has no changes. */
const orNone = ({ data, isError }: UseQueryResult<PairedChanges>) => data?.changes ?? (isError ? {} : undefined);

export function usePaired(shown: Shown | null, pins: readonly Variant[], against: Variant | null): Compared["paired"] {
  const other = against?.shown;
  const runs = useMemo(() => {
    const results = [shown, ...pins.map((pin) => pin.shown)].filter((each) => each !== null);
    const compared = results.filter((each) => other && roadsOf(each) > 1 && each.runId !== other.runId && whyNotCompared(each, other) === null);
    return [...new Set(compared.flatMap(({ runId }) => runId ?? []))];
  }, [shown, pins, other]);
  return useQueries({
    queries: runs.map((run) => changesQuery(run, other?.runId ?? "")),
    combine: useCallback(
      (results: readonly UseQueryResult<PairedChanges>[]): Compared["paired"] =>
        Object.fromEntries(
          runs.flatMap((run, index) => {
            const result = results[index];
            const changes = result && orNone(result);
            return changes ? [[run, changes]] : [];
          }),
        ),
      [runs],
    ),
  });
}
