/** Keeps the address bar and the page's view the same thing. */

import { formatAddress, parseAddress, type Address, type View } from "./address";
import { createStore, type Store } from "./store";

export interface Router extends Pick<Store<Address>, "get" | "subscribe"> {
  /** Shows another run; a new entry in the browser's history unless it is the same one. */
  readonly showRun: (runId: string, view: Partial<View>, mode: "push" | "replace") => void;
  /** Changes how the run is looked at; no new entry. */
  readonly setView: (change: Partial<View>) => void;
  /** Back or forward was pressed. */
  readonly onTravel: (listener: (address: Address) => void) => () => void;
}

export function createRouter(): Router {
  const read = () => parseAddress(window.location.pathname, window.location.search);
  const store = createStore<Address>(read());

  const write = (address: Address, mode: "push" | "replace") => {
    store.set(address);
    const url = formatAddress(address);
    if (mode === "push") window.history.pushState(null, "", url);
    else window.history.replaceState(null, "", url);
  };

  return {
    get: store.get,
    subscribe: store.subscribe,
    showRun: (runId, view, mode) => {
      const { runId: current, view: seen } = store.get();
      write({ runId, slug: null, view: { ...seen, ...view } }, runId === current ? "replace" : mode);
    },
    setView: (change) => {
      const address = store.get();
      write({ ...address, view: { ...address.view, ...change } }, "replace");
    },
    onTravel: (listener) => {
      const handle = () => {
        store.set(read());
        listener(store.get());
      };
      window.addEventListener("popstate", handle);
      return () => window.removeEventListener("popstate", handle);
    },
  };
}
