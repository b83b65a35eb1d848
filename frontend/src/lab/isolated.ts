/** The strategy whose curves stand out: the one that is pointed at, else the one that was tapped in the legend. */

import type { StrategyId } from "../api/types";
import { createStore } from "../lib/store";

interface Isolated {
  readonly pointed: StrategyId | null;
  readonly held: StrategyId | null;
}

const store = createStore<Isolated>({ pointed: null, held: null });

export const isolated = {
  subscribe: store.subscribe,
  get: (): StrategyId | null => store.get().pointed ?? store.get().held,
};

/** For a legend's entry under the mouse; a finger leaves as it taps. */
export const isolateWhilePointed = (id: StrategyId) => ({
  onPointerEnter: ({ pointerType }: { readonly pointerType: string }) => {
    if (pointerType === "mouse") store.set(({ held }) => ({ held, pointed: id }));
  },
  onPointerLeave: () => store.set(({ held }) => ({ held, pointed: null })),
});

/** Until it is tapped again. */
export const holdIsolated = (id: StrategyId): void =>
  store.set(({ pointed, held }) => ({ pointed, held: held === id ? null : id }));
