/** The stretch being drawn with the pointer to zoom into; all panels show it. */

import { createStore } from "../lib/store";

export interface Brush {
  readonly from: number;
  readonly to: number;
}

export const brush = createStore<Brush | null>(null);
