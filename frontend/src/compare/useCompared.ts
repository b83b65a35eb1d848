/** What the shown result is compared with, for the scene. */

import { useMemo } from "react";
import type { Compared } from "../state/compare";
import { useLab } from "../state/context";
import { beforeEdit } from "../state/shown";
import { usePins } from "./usePins";

export function useCompared(): Compared {
  const before = useLab(beforeEdit);
  const pinned = usePins();
  return useMemo(() => {
    const pins = pinned.flatMap(({ name, run, shown }, index) => (shown ? [{ name, run, shown, index }] : []));
    return { before, pins };
  }, [before, pinned]);
}
