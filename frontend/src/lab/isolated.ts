/** The strategy whose curves stand out: the one that is pointed at, else the one that was tapped in the legend. */

import { createStore, useSelector } from "@tanstack/react-store";
import type { StrategyId } from "../api/types";

interface Isolated {
  readonly pointed: StrategyId | null;
  readonly held: StrategyId | null;
}

const store = createStore<Isolated>({ pointed: null, held: null });

export const useIsolated = (): StrategyId | null => useSelector(store, ({ pointed, held }) => pointed ?? held);

/** For a legend's entry under the mouse; a finger leaves as it taps. */
export const isolateWhilePointed = (id: StrategyId) => ({
  onPointerEnter: ({ pointerType }: { readonly pointerType: string }) => {
    if (pointerType === "mouse") store.setState(({ held }) => ({ held, pointed: id }));
  },
  onPointerLeave: () => store.setState(({ held }) => ({ held, pointed: null })),
});

/** Until it is tapped again. */
export const holdIsolated = (id: StrategyId): void =>
  store.setState(({ pointed, held }) => ({ pointed, held: held === id ? null : id }));
