/** The page's one controller: what is edited, over what it is driven, and which of it is shown. */

import { createRequests } from "./requests";
import { type LabForm, type Services, hasInvalidInput, type Lab, type LabState } from "./labState";
import type { Scenario, StrategyId } from "../api/types";
import { begin, record, redo, undo, type History } from "./history";
import { NO_ERRORS } from "./problems";
import { answers } from "./result";
import { createAtom } from "@tanstack/react-store";

const OPENING_STRATEGIES: readonly StrategyId[] = ["lv", "lqr", "passive"];

const OPENING: LabState = {
  history: null,
  drag: null,
  invalidInput: {},
  serverErrors: NO_ERRORS,
  strategies: OPENING_STRATEGIES,
  roads: 1,
  shown: null,
  latestResult: null,
  previousResult: null,
  shared: null,
  busy: false,
  stale: false,
  failure: null,
};

/** `initial` is what it opens with where no address says what. */
export function createLab(services: Services, initial: Partial<LabState> = {}): Lab {
  const { labAddress } = services;
  const store = createAtom<LabState>({ ...OPENING, ...initial });
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));
  let form: LabForm = { group: null, signals: [] };
  const requests = createRequests(store, services, () => form);
  const { submit } = requests;

  const move = (step: (history: History<Scenario>) => History<Scenario>) => {
    const { history, shared } = store.get();
    if (!history || shared) return;
    const next = step(history);
    if (next === history) return;
    patch({ history: next, invalidInput: {}, drag: null });
    submit("replace"); // the browser's Back goes through edits, not through each undo of them
  };

  /** Shows those of the result that is there; no other answer is waited for. */
  const hideOthers = (strategies: readonly StrategyId[], computed: readonly StrategyId[]) => {
    requests.cancel();
    labAddress.setView({ hidden: computed.filter((strategy) => !strategies.includes(strategy)) });
  };

  const open: Lab["open"] = ({ runId, slug, view }) => {
    if (slug !== null) requests.openLink(slug);
    else if (runId !== null) requests.load(runId, view.hidden);
    else submit("replace");
  };

  return {
    get: store.get,
    subscribe: store.subscribe,
    newest: requests.newest,
    draw: requests.draw,
    open,
    navigate: (address) => {
      // The browser has changed the address already: that what is shown is not of it is said at once.
      patch({ stale: true });
      open(address);
    },
    openPaper: () => {
      const { history, invalidInput, strategies, roads, shown, latestResult, previousResult, shared } = OPENING;
      patch({ history, invalidInput, strategies, roads, shown, latestResult, previousResult, shared });
      submit("push");
    },
    openCopy: () => {
      if (store.get().shared) submit("push");
    },
    configure: (group, signals) => {
      form = { group, signals };
    },
    drag: (scenario) => {
      if (store.get().shared) return;
      patch({ drag: scenario });
      requests.preview();
    },
    commit: (scenario) => {
      const { history, shared } = store.get();
      if (shared) return;
      patch({ history: history ? record(history, scenario) : begin(scenario), drag: null });
      submit("push");
    },
    reject: (pointer, input) => patch({ invalidInput: { ...store.get().invalidInput, [pointer]: input } }),
    clearInvalid: (pointer) => {
      const { [pointer]: removed, ...rest } = store.get().invalidInput;
      if (removed) patch({ invalidInput: rest });
    },
    undo: () => {
      // A text that is no value is the newest change.
      if (hasInvalidInput(store.get())) patch({ invalidInput: {} });
      else move(undo);
    },
    redo: () => move(redo),
    setStrategies: (ids) => {
      const { shown, history, shared, roads, drag } = store.get();
      const computed = shown?.source === "exact" ? Object.keys(shown.summaries) : [];
      const strategies = shared ? ids.filter((strategy) => computed.includes(strategy)) : ids;
      patch({ strategies });
      const answered =
        shown !== null && drag === null && answers(shown, { scenario: history?.present, roads, strategies });
      if (shared || answered) hideOthers(strategies, computed);
      else submit("push");
    },
    runAgain: () => {
      if (!store.get().shared) submit("push");
    },
    setRoads: (roads) => {
      if (store.get().shared) return;
      patch({ roads });
      submit("push");
    },
    resume: requests.resume,
  };
}
