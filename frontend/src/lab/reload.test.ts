import { QueryClient } from "@tanstack/react-query";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { Link, Scenario } from "../api/types";
import { memoryStorage } from "../lib/storage.fixture";
import { DEFAULT_VIEW } from "./address";
import { begin, record, undo } from "./history";
import { createLab } from "./lab";
import type { LabState } from "./labState";
import { restoreBefore, restoreTab, storeTab } from "./session";
import type { Result } from "./result";
import { createAtom } from "@tanstack/react-store";

const [PAPER, LOW, HIGH]: readonly Scenario[] = [{ height: 1 }, { height: 2 }, { height: 3 }];
const resultOf = (runId: string, scenario: Scenario | undefined) =>
  ({ source: "exact", runId, scenario, over: null }) as unknown as Result;

beforeEach(() => void vi.stubGlobal("sessionStorage", memoryStorage()));
afterEach(() => void vi.unstubAllGlobals());

const router = createAtom({ runId: null, slug: null, view: DEFAULT_VIEW });
const labWith = (state: Partial<LabState>) =>
  createLab({ api: {} as never, labAddress: router as never, queries: new QueryClient() }, state);

/** A lab that has shown and stored this. */
function left(state: Partial<LabState>) {
  const store = createAtom<LabState>(labWith({}).get());
  storeTab(store);
  store.set((before) => ({ ...before, ...state }));
  return (change: Partial<LabState>) => store.set((before) => ({ ...before, ...change }));
}

const HISTORY = undo(record(record(begin(PAPER ?? {}), LOW ?? {}), HIGH ?? {}));

it("A tab that is loaded again has its undo, its redo and the run before the last edit, at the address it was at", () => {
  left({ history: HISTORY, latestResult: resultOf("R2", LOW), previousResult: resultOf("R3", HIGH) });
  const tab = { run: "R2", before: "R3", history: HISTORY };
  expect(restoreTab({ runId: "R2", scenario: null })).toEqual(tab);
  expect(restoreTab({ runId: "R9", scenario: null })).toBeNull();
  expect(restoreTab({ runId: null, scenario: { height: 2 } })).toEqual(tab);
  expect(restoreTab({ runId: null, scenario: { height: 9 } })).toBeNull();
  expect(restoreTab({ runId: null, scenario: null })).toBeNull();
});

it("What is stored of a tab is bounded, and nothing of a link", () => {
  const scenarios = Array.from({ length: 150 }, (_, height) => ({ height }));
  const all = scenarios.reduce((history, scenario) => record(history, scenario), begin<Scenario>({}));
  const long = Array.from({ length: 75 }, () => undo<Scenario>).reduce((history, step) => step(history), all);
  const patch = left({ history: long, latestResult: resultOf("R", { height: 74 }) });
  patch({
    history: begin<Scenario>({ height: 1000 }),
    latestResult: resultOf("L", { height: 1000 }),
    shared: {} as Link,
  });
  const stored = restoreTab({ runId: "R", scenario: null })?.history;
  expect([stored?.past.length, stored?.future.length]).toEqual([50, 50]);
  expect([stored?.past.at(-1), stored?.present, stored?.future[0]]).toEqual([
    { height: 73 },
    { height: 74 },
    { height: 75 },
  ]);
  expect(restoreTab({ runId: "L", scenario: null })).toBeNull();
});

it("What cannot be read is no tab's", () => {
  for (const text of [
    "{",
    "3",
    '{"run": "R", "before": null, "history": {"past": [1], "present": {}, "future": []}}',
    '{"run": "R", "history": {}}',
  ]) {
    sessionStorage.setItem("ridelab-tab", text);
    expect(restoreTab({ runId: "R", scenario: null })).toBeNull();
  }
});

it("The run before the last edit is asked for once, when the run that was shown is there", async () => {
  const store = createAtom(labWith({}).get());
  const compareWith = vi.fn();
  restoreBefore({ ...store, compareWith }, { run: "R2", before: "R1", history: HISTORY }, (run) =>
    Promise.resolve(resultOf(run, PAPER)),
  );
  store.set((state) => ({ ...state, busy: true }));
  await Promise.resolve();
  expect(compareWith).not.toHaveBeenCalled();
  store.set((state) => ({ ...state, latestResult: resultOf("R2", LOW) }));
  store.set((state) => ({ ...state, busy: false }));
  await vi.waitFor(() => expect(compareWith.mock.calls).toEqual([[LOW, resultOf("R1", PAPER)]]), 60_000);
});

it("It is what changes are against again, unless there is another one, or another scenario is shown by then", () => {
  const compared = (state: Partial<LabState>) => {
    const lab = labWith({ latestResult: resultOf("R2", LOW), ...state });
    lab.compareWith(LOW ?? {}, resultOf("R1", PAPER));
    return lab.get().previousResult?.runId;
  };
  expect([
    compared({}),
    compared({ previousResult: resultOf("R8", HIGH) }),
    compared({ latestResult: resultOf("R3", HIGH) }),
  ]).toEqual(["R1", "R8", undefined]);
});
