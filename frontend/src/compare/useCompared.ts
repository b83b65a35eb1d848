/** What the shown result is compared with, for the scene. */

import { useMemo } from "react";
import { againstOf, type Compared } from "../state/compare";
import { useLab, useView } from "../state/context";
import { useStore } from "../state/store";
import { beforeShown, useBefore } from "./useBefore";
import { usePaired } from "./usePaired";
import { usePins } from "./usePins";

export function useCompared(): Compared {
  const shown = useLab((state) => state.shown);
  const { against } = useView();
  const before = useBefore();
  const isShown = useStore(beforeShown);
  const pinned = usePins();
  const variants = useMemo(() => {
    const pins = pinned.flatMap(({ name, run, shown: result }, index) => (result ? [{ name, run, shown: result, index }] : []));
    return { before: isShown ? before : null, pins };
  }, [before, isShown, pinned]);
  const paired = usePaired(shown, variants.pins, againstOf(variants, against));
  return useMemo(() => ({ ...variants, paired }), [variants, paired]);
}
