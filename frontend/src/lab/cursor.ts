/** What somebody points at: a place of the run, which all plots and the car share (outside React: it moves with every frame), and a strategy. */

import type { Axis } from "./address";
import { createAtom, useSelector } from "@tanstack/react-store";
import type { StrategyId } from "../api/types";

/** Where somebody points, `null` while nobody does. */
const store = createAtom<{ readonly axis: Axis; readonly at: number } | null>(null);

export const cursor = {
  /** The place on this axis (m or s); `null` where nobody points, or points on the other axis. */
  get: (axis: Axis): number | null => {
    const place = store.get();
    return place?.axis === axis ? place.at : null;
  },
  set: (axis: Axis, at: number | null): void => store.set(at === null ? null : { axis, at }),
  subscribe: store.subscribe,
};

export const useCursor = (axis: Axis): number | null => useSelector(store, () => cursor.get(axis));

const [pointed, held] = [createAtom<StrategyId | null>(null), createAtom<StrategyId | null>(null)];
const isolated = createAtom(() => pointed.get() ?? held.get());

/** The strategy whose curves stand out: the one that is pointed at, else the one that was tapped in the legend. */
export const useIsolated = (): StrategyId | null => useSelector(isolated);

/** For a legend's entry under the mouse; a finger leaves as it taps. */
export const isolateWhilePointed = (id: StrategyId) => ({
  onPointerEnter: ({ pointerType }: { readonly pointerType: string }) => {
    if (pointerType === "mouse") pointed.set(id);
  },
  onPointerLeave: () => pointed.set(null),
});

/** Until it is tapped again. */
export const holdIsolated = (id: StrategyId): void => held.set((before) => (before === id ? null : id));
