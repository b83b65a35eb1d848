/** What the shown result is compared with, for the scene. */

import { useMemo } from "react";
import type { Compared } from "../../lab/compare";
import { useStore } from "../../lib/store";
import { beforeShown, useBefore } from "./useBefore";
import { usePins } from "./usePins";

export function useCompared(): Compared {
  const before = useBefore();
  const isShown = useStore(beforeShown);
  const pinned = usePins();
  return useMemo(() => {
    const pins = pinned.flatMap(({ name, run, shown }, index) => (shown ? [{ name, run, shown, index }] : []));
    return { before: isShown ? before : null, pins };
  }, [before, isShown, pinned]);
}
