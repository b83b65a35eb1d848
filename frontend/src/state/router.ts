/** Keeps the address bar and what the page shows the same thing. */

import { formatAddress, parseAddress, type Address, type View } from "./address";
import { createStore, type Store } from "./store";

/** Its value is the address of what is shown. */
export interface Router extends Pick<Store<Address>, "get" | "subscribe"> {
  /** Shows another run; a new entry in the browser's history unless it is the same one. */
  readonly showRun: (runId: string, view: Partial<View>, mode: "push" | "replace") => void;
  /** Changes how the run is looked at; no new entry. */
  readonly setView: (change: Partial<View>) => void;
  /** Back or forward was pressed: the browser has changed the address bar, and what it names has yet to be shown. */
  readonly onTravel: (listener: (address: Address) => void) => () => void;
  /** What the address bar names is shown now. */
  readonly arrive: () => void;
}

export function createRouter(): Router {
  const read = () => parseAddress(window.location.pathname, window.location.search);
  const store = createStore<Address>(read());

  /** Where back or forward led, until it is shown. */
  let pending: Address | null = null;

  const write = (address: Address, mode: "push" | "replace") => {
    pending = null;
    store.set(address);
    const url = formatAddress(address);
    if (mode === "push") window.history.pushState(null, "", url);
    else window.history.replaceState(null, "", url);
  };
  const arrive = () => {
    if (pending) store.set(pending);
    pending = null;
  };

  return {
    get: store.get,
    subscribe: store.subscribe,
    showRun: (runId, view, mode) => {
      const current = pending ?? store.get();
      write({ runId, slug: null, view: { ...store.get().view, ...view } }, runId === current.runId ? "replace" : mode);
    },
    setView: (change) => {
      const look = (address: Address): Address => ({ ...address, view: { ...address.view, ...change } });
      store.set(look);
      pending = pending && look(pending);
      window.history.replaceState(null, "", formatAddress(pending ?? store.get()));
    },
    onTravel: (listener) => {
      const handle = () => {
        pending = read();
        listener(pending);
      };
      window.addEventListener("popstate", handle);
      return () => window.removeEventListener("popstate", handle);
    },
    arrive,
  };
}
