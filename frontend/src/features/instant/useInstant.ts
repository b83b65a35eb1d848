/** The instant under the cursor: asked for at most ten times a second, one question at a time, the newest last. */

import { useThrottledCallback } from "@mantine/hooks";
import { useEffect, useMemo, useState } from "react";
import { ask } from "../../api/http";
import { isTransient, messageOf } from "../../api/problem";
import type { InstantAnswer, StrategyId } from "../../api/types";
import type { Axis } from "../../lab/address";
import { cursor } from "../../lab/cursor";
import { axisKey } from "../../lab/resultView";
import { createLatest } from "../../lib/latest";

/** Between two questions [ms]. */
const PACE_MS = 100;

interface Shown {
  readonly answer: InstantAnswer | null;
  /** Why there is none at the cursor. */
  readonly fault: string | null;
}

/** `null` as a run is a preview, whose instants nobody can ask for. */
export function useInstant(runId: string | null, strategy: StrategyId, axis: Axis): Shown {
  const [shown, setShown] = useState<Shown>({ answer: null, fault: null });
  const latest = useMemo(
    () =>
      createLatest<number, InstantAnswer>({
        run: (at, signal) =>
          ask(
            "get",
            "/runs/{id}/instant",
            { path: { id: runId ?? "" }, query: { strategy, [axisKey(axis)]: at } },
            signal,
          ),
        onAnswer: (answer) => setShown({ answer, fault: null }),
        onError: (error) => {
          if (!isTransient(error)) setShown({ answer: null, fault: messageOf(error) });
        },
      }),
    [runId, strategy, axis],
  );
  const follow = useThrottledCallback(() => {
    const at = cursor.get(axis);
    if (runId !== null && at !== null) latest.request(at);
  }, PACE_MS);
  useEffect(() => {
    follow();
    const following = cursor.subscribe(follow);
    return () => {
      following.unsubscribe();
      latest.cancel();
    };
  }, [follow, latest]);
  return shown;
}
