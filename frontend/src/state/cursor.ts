/** The cursor all plots and the car share, and its playback. Outside React: it moves with every frame. */

import { createStore } from "./store";

/** Position on the shared axis, in that axis's unit (m or s); `null` while nobody points anywhere. */
export const cursor = createStore<number | null>(null);
