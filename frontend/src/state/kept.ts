/** What a closed tab comes back with: the lab's scenario and how it was looked at. */

import type { Scenario, StrategyId } from "../api/types";
import { parseSearch, readLabSearch, searchOf, stringifySearch, viewOf, type View } from "./address";
import { begin } from "./history";
import type { Lab, LabState } from "./labState";
import type { Router } from "./router";

const NAME = "ridelab-lab";

interface Kept {
  readonly scenario: Scenario;
  readonly strategies: readonly StrategyId[];
  readonly roads: number;
  readonly search: string;
}

const isKept = (value: unknown): value is Kept =>
  typeof value === "object" &&
  value !== null &&
  "scenario" in value &&
  typeof value.scenario === "object" &&
  value.scenario !== null &&
  "strategies" in value &&
  Array.isArray(value.strategies) &&
  "roads" in value &&
  typeof value.roads === "number" &&
  "search" in value &&
  typeof value.search === "string";

export interface Restored {
  readonly lab: Pick<LabState, "history" | "strategies" | "roads">;
  readonly view: View;
}

/** `null` where nothing was kept, or the browser keeps nothing. */
export function restore(): Restored | null {
  try {
    const value: unknown = JSON.parse(localStorage.getItem(NAME) ?? "null");
    if (!isKept(value)) return null;
    const { scenario, strategies, roads, search } = value;
    return { lab: { history: begin(scenario), strategies, roads }, view: viewOf(readLabSearch(parseSearch(search))) };
  } catch {
    return null;
  }
}

export function keep(lab: Lab, router: Router): void {
  let written: readonly unknown[] = [];
  const write = () => {
    const { history, strategies, roads, shared } = lab.get();
    const { view } = router.get();
    const parts = [history?.present, strategies, roads, view];
    // A moving slider changes none of them.
    if (!history || shared || parts.every((part, index) => part === written[index])) return;
    written = parts;
    const kept: Kept = { scenario: history.present, strategies, roads, search: stringifySearch(searchOf({ ...view, hidden: [] })) };
    try {
      localStorage.setItem(NAME, JSON.stringify(kept));
    } catch {
      // Full, or forbidden: then a closed tab does not come back.
    }
  };
  lab.subscribe(write);
  router.subscribe(write);
}
