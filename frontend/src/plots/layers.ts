/** Curves of other variants under the shown ones: the state before the last edit as a thin ghost, pins each with a dash. */

import type { SeriesByStrategy } from "../api/types";
import type { Scene } from "../state/scene";

export interface Layer {
  /** Behind the strategy's name. */
  readonly name: string;
  readonly series: SeriesByStrategy;
  /** In place of the strategy's own. */
  readonly line: Readonly<{ width?: number; dash?: string }>;
  readonly opacity: number;
}

/** By pin, in their order; the list of pins shows the same. */
const PIN_DASHES: readonly string[] = ["2,2", "8,3", "5,2,1,2", "1,3", "12,3", "8,2,1,2,1,2", "3,6", "16,4"];

export const BEFORE_WIDTH = 1;
export const PIN_WIDTH = 1.2;

export const pinDash = (index: number): string => PIN_DASHES[index % PIN_DASHES.length] ?? "2,2";

export function layersOf({ shown, before, pins }: Pick<Scene, "shown" | "before" | "pins">): readonly Layer[] {
  const ghost = before ? [{ name: before.name, series: before.shown.series, line: { width: BEFORE_WIDTH }, opacity: 0.65 }] : [];
  // A pinned result that is what is shown has no curves beside those.
  const others = pins.filter((pin) => pin.shown.runId === null || pin.shown.runId !== shown.runId);
  const pinned = others.map(({ name, shown: { series }, index = 0 }) => ({ name, series, line: { width: PIN_WIDTH, dash: pinDash(index) }, opacity: 0.8 }));
  return [...ghost, ...pinned];
}
