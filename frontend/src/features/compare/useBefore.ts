/** The state before the last edit, as a variant to compare with; whether it is shown is remembered. */

import { useQuery, useQueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import type { Variant } from "../../lab/compare";
import { useLab } from "../../lab/context";
import { beforeEdit, isUndone, roadsOf } from "../../lab/result";
import { readStored, writeStored } from "../../lib/storage";
import { createStore, useStore } from "../../lib/store";
import { loadPinned, pinnedKey } from "./usePins";

const NAME = "ridelab-before";

export const beforeShown = createStore(readStored(NAME) !== false);

export function showBefore(isShown: boolean): void {
  beforeShown.set(isShown);
  writeStored(NAME, isShown ? null : false);
}

export const [BEFORE_EDIT, BEFORE_UNDO] = ["before the last edit", "before the undo"];

/** Where the lab drives another number of roads by now, over as many. */
export function useBefore(): Variant | null {
  const queries = useQueryClient();
  const before = useLab(beforeEdit);
  const history = useLab((state) => state.history);
  const roads = useLab((state) => state.roads);
  const isShown = useStore(beforeShown);
  const id = before?.runId ?? "";
  const isUnlike = before !== null && roadsOf(before) !== roads;
  const { data } = useQuery({
    queryKey: [...pinnedKey(id), roads],
    queryFn: ({ signal }) => loadPinned(id, roads, queries, signal),
    enabled: isShown && isUnlike && id !== "",
    staleTime: Infinity,
    structuralSharing: false,
  });
  const shown = isUnlike ? (data ?? before) : before;
  const name = useMemo(() => (before && isUndone(before, history) ? BEFORE_UNDO : BEFORE_EDIT), [before, history]);
  return useMemo(() => shown && { name, shown }, [name, shown]);
}
