/** What a closed tab comes back with: the last scenario that was computed, and how it was looked at. */

import type { Scenario, StrategyId } from "../api/types";
import { sameValue } from "../scenario/path";
import { SCHEMA_VERSION, upgraded } from "../scenario/versions";
import { parseSearch, readLabSearch, searchOf, stringifySearch, viewOf, type View } from "./address";
import { begin } from "./history";
import type { Lab, LabState } from "./labState";
import { hasErrors } from "./problems";
import type { LabAddress } from "./labAddress";
import { roadsOf } from "./result";
import { readStored, writeStored, isLike } from "../lib/storage";

const NAME = "ridelab-lab";

interface StoredSession {
  /** Of the scenario's schema; core 0.3.0 and before did not store it. */
  readonly version?: number;
  readonly scenario: Scenario;
  readonly strategies: readonly StrategyId[];
  readonly roads: number;
  readonly search: string;
}

const SESSION: StoredSession = { scenario: {}, strategies: [], roads: 1, search: "" };

export interface RestoredSession {
  readonly lab: Pick<LabState, "history" | "strategies" | "roads">;
  readonly view: View;
}

/** `null` where nothing was kept, or the browser keeps nothing. */
export function restoreSession(): RestoredSession | null {
  const value = readStored(NAME);
  if (!isLike(SESSION, value)) return null;
  const { version = 1, scenario, strategies, roads, search } = value;
  return {
    lab: { history: begin(upgraded(scenario, version)), strategies, roads },
    view: viewOf(readLabSearch(parseSearch(search))),
  };
}

export function storeSession(lab: Pick<Lab, "get" | "subscribe">, router: Pick<LabAddress, "get" | "subscribe">): void {
  let written: readonly unknown[] = [];
  /** Of a run or link that was opened: until it is edited, what somebody else made replaces nothing of one's own. */
  let unedited: Scenario | null = null;
  const write = () => {
    const { latestResult, strategies, shared, busy, failure, serverErrors } = lab.get();
    // What the server has not taken yet, it may refuse.
    if (!latestResult || busy || failure || hasErrors(serverErrors)) return;
    const { scenario } = latestResult;
    if (shared || latestResult.timing.opened) unedited = scenario;
    if (sameValue(scenario, unedited)) return;
    unedited = null;
    const roads = roadsOf(latestResult);
    const { view } = router.get();
    const parts = [scenario, strategies, roads, view];
    if (parts.every((part, index) => part === written[index])) return;
    written = parts;
    const session: StoredSession = {
      version: SCHEMA_VERSION,
      scenario,
      strategies,
      roads,
      search: stringifySearch(searchOf({ ...view, hidden: [], instant: null })),
    };
    writeStored(NAME, session);
  };
  lab.subscribe(write);
  router.subscribe(write);
}
