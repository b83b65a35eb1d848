/** What the shown result is compared with, for the scene. */

import { useMemo } from "react";
import type { Compared } from "../state/compare";
import { useLab } from "../state/context";
import { beforeEdit } from "../state/shown";

export function useCompared(): Compared {
  const before = useLab(beforeEdit);
  const against = useLab((state) => state.against);
  return useMemo(() => ({ before, pins: [], against }), [before, against]);
}
