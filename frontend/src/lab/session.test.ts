import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { Link, Scenario } from "../api/types";
import { memoryStorage } from "../lib/storage.fixture";
import { DEFAULT_VIEW } from "./address";
import { begin } from "./history";
import { storeSession, restoreSession } from "./session";
import { createLab } from "./lab";
import type { LabState } from "./labState";
import { NO_ERRORS } from "./problems";
import type { Result } from "./result";
import { createAtom } from "@tanstack/react-store";

const LOW: Scenario = { height: 0.06 };
const REFUSED: Scenario = { height: -1 };
const THEIRS: Scenario = { height: 0.2 };
const exactOf = (scenario: Scenario, opened = false) =>
  ({ source: "exact", scenario, over: null, timing: { opened } }) as unknown as Result;

beforeEach(() => void vi.stubGlobal("localStorage", memoryStorage()));
afterEach(() => void vi.unstubAllGlobals());

function open() {
  const router = createAtom({ runId: null, slug: null, view: DEFAULT_VIEW });
  const opening = createLab({ api: {} as never, labAddress: router as never, queries: {} as never }).get();
  const store = createAtom<LabState>({ ...opening, history: begin(LOW), latestResult: exactOf(LOW), busy: true });
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));
  storeSession(store, router);
  return patch;
}

it("A tab comes back with the last scenario that was computed, not with one on its way or refused", () => {
  const patch = open();
  patch({ busy: true });
  expect(restoreSession()).toBeNull();
  patch({ busy: false });
  patch({ history: begin(REFUSED), busy: true });
  patch({ serverErrors: { ...NO_ERRORS, general: ["too low"] }, busy: false });
  expect(restoreSession()?.lab.history?.present).toEqual(LOW);
});

it("A run or a link that is opened replaces nothing until it is edited", () => {
  const patch = open();
  const scenario = () => restoreSession()?.lab.history?.present;
  patch({ busy: false });
  patch({ latestResult: exactOf(THEIRS, true) });
  patch({ latestResult: exactOf(THEIRS), strategies: ["lv"] });
  patch({ latestResult: exactOf(THEIRS, true), shared: {} as Link });
  patch({ latestResult: exactOf(THEIRS), shared: null });
  expect(scenario()).toEqual(LOW);
  patch({ latestResult: exactOf({ height: 0.3 }) });
  expect(scenario()).toEqual({ height: 0.3 });
  patch({ latestResult: exactOf(THEIRS) });
  expect(scenario()).toEqual(THEIRS);
});

it("A tab that core 0.3.0 stored comes back with the filter it had", () => {
  const stored = { scenario: { estimation: { kind: "kalman" } }, strategies: ["lv"], roads: 1, search: "" };
  localStorage.setItem("ridelab-lab", JSON.stringify(stored));
  expect(restoreSession()?.lab.history?.present).toEqual({ estimation: { kind: "kalman", knows_preview: false } });
});
