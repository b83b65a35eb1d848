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

/** By pin, in their order; the same in the table's names. */
export const PIN_DASHES: readonly string[] = ["2,2", "8,3", "5,2,1,2", "1,3", "12,3", "8,2,1,2,1,2", "3,6", "16,4"];

export function layersOf({ before, pins }: Pick<Scene, "before" | "pins">): readonly Layer[] {
  const ghost = before ? [{ name: "before the edit", series: before.series, line: { width: 1 }, opacity: 0.65 }] : [];
  const pinned = pins.map(({ name, shown }, index) => ({
    name,
    series: shown.series,
    line: { width: 1.2, dash: PIN_DASHES[index % PIN_DASHES.length] ?? "2,2" },
    opacity: 0.8,
  }));
  return [...ghost, ...pinned];
}
