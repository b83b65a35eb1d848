/** What a closed tab comes back with: the last scenario that was computed, and how it was looked at. */

import type { Scenario, StrategyId } from "../api/types";
import { sameValue } from "../scenario/path";
import { SCHEMA_VERSION, upgraded } from "../scenario/versions";
import { parseSearch, readLabSearch, searchOf, stringifySearch, viewOf, type View } from "./address";
import { begin, type History } from "./history";
import type { Lab, LabState } from "./labState";
import { hasErrors } from "./problems";
import type { LabAddress } from "./labAddress";
import { roadsOf, type Result } from "./result";
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

const TAB = "ridelab-tab";
/** Steps in either direction: a scenario takes some 4 kB, and a browser keeps 5 MB. */
const MOST_STEPS = 50;

/** What a tab has beside its address when it is loaded again: undo and redo, and the state before the last edit. */
interface StoredTab {
  /** The run that was shown. */
  readonly run: string;
  /** The run before the last edit. */
  readonly before: string | null;
  readonly history: History<Scenario>;
}

const TEMPLATE: StoredTab = { run: "", before: null, history: { past: [{}], present: {}, future: [{}] } };

/** What was stored of this tab, where it is of the run at its address, or of the scenario (then its present) that the lab opens with; else `null`. */
export function restoreTab(opens: {
  readonly runId: string | null;
  readonly scenario: Scenario | null;
}): StoredTab | null {
  const tab = readStored(TAB, "sessionStorage");
  if (!isLike(TEMPLATE, tab)) return null;
  const { runId, scenario } = opens;
  if (runId !== null) return runId === tab.run ? tab : null;
  return scenario !== null && sameValue(scenario, tab.history.present)
    ? { ...tab, history: { ...tab.history, present: scenario } }
    : null;
}

export function storeTab(lab: Pick<Lab, "get" | "subscribe">): void {
  let written: readonly unknown[] = [];
  lab.subscribe(() => {
    const { latestResult, previousResult, history, shared } = lab.get();
    const parts = [latestResult, previousResult, history];
    if (shared || !latestResult?.runId || !history || parts.every((part, index) => part === written[index])) return;
    written = parts;
    const { past, present, future } = history;
    const tab: StoredTab = {
      run: latestResult.runId,
      before: previousResult?.runId ?? null,
      history: { past: past.slice(-MOST_STEPS), present, future: future.slice(0, MOST_STEPS) },
    };
    writeStored(TAB, tab, "sessionStorage");
  });
}

/** Asks for the run before the last edit, once the run that was shown is there again. */
export function restoreBefore(
  lab: Pick<Lab, "get" | "subscribe" | "compareWith">,
  { before }: StoredTab,
  load: (run: string) => Promise<Result>,
): void {
  if (before === null) return;
  const subscription = lab.subscribe(() => {
    const { latestResult } = lab.get();
    if (!latestResult) return;
    subscription.unsubscribe();
    load(before).then(
      (shown) => lab.compareWith(latestResult.scenario, shown),
      () => undefined, // no longer stored, or no server: then there is none to compare with
    );
  });
}
