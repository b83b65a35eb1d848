/** What a tab has beside its address when it is loaded again: undo and redo, and the state before the last edit. */

import type { Scenario } from "../api/types";
import { sameValue } from "../scenario/path";
import type { History } from "./history";
import type { Lab } from "./labState";
import type { Shown } from "./result";
import { isLike, readStored, writeStored } from "../lib/storage";

const NAME = "ridelab-tab";
/** Steps in either direction: a scenario takes some 4 kB, and a browser keeps 5 MB. */
const MOST_STEPS = 50;

export interface StoredTab {
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
  const tab = readStored(NAME, "sessionStorage");
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
    const { exact, before, history, shared } = lab.get();
    const parts = [exact, before, history];
    if (shared || !exact?.runId || !history || parts.every((part, index) => part === written[index])) return;
    written = parts;
    const { past, present, future } = history;
    const tab: StoredTab = {
      run: exact.runId,
      before: before?.runId ?? null,
      history: { past: past.slice(-MOST_STEPS), present, future: future.slice(0, MOST_STEPS) },
    };
    writeStored(NAME, tab, "sessionStorage");
  });
}

/** Asks for the run before the last edit, once the run that was shown is there again. */
export function restoreBefore(
  lab: Pick<Lab, "get" | "subscribe" | "compareWith">,
  { before }: StoredTab,
  load: (run: string) => Promise<Shown>,
): void {
  if (before === null) return;
  const stop = lab.subscribe(() => {
    const { exact } = lab.get();
    if (!exact) return;
    stop();
    load(before).then(
      (shown) => lab.compareWith(exact.scenario, shown),
      () => undefined, // no longer stored, or no server: then there is none to compare with
    );
  });
}
