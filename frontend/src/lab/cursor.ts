/** The cursor all plots and the car share, and its playback. Outside React: it moves with every frame. */

import type { Axis } from "./address";
import { createAtom, useSelector } from "@tanstack/react-store";

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
