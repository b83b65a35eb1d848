/** The lab's part of the address: keeps the address bar and what the lab shows the same thing. */

import { linkOptions, type RegisteredRouter } from "@tanstack/react-router";
import { DEFAULT_VIEW, readLabSearch, searchOf, stringifySearch, viewOf, type Address, type View } from "./address";
import { createAtom } from "@tanstack/react-store";

declare module "@tanstack/react-router" {
  interface HistoryState {
    /** The lab itself wrote the entry: told from a link by this, however late the browser's history tells of it. */
    ofLab?: true;
  }
}

export type LabAddress = ReturnType<typeof createLabAddress>;

const START: Address = { runId: null, slug: null, view: DEFAULT_VIEW };

/** Whether no result is asked for: the lab opens as it was left. */
export function startsAnew(router: RegisteredRouter): boolean {
  const address = readAddress(router);
  return address === null || (address.runId === null && address.slug === null);
}

const isSame = (one: Address, other: Address) =>
  one.runId === other.runId &&
  one.slug === other.slug &&
  stringifySearch(searchOf(one.view)) === stringifySearch(searchOf(other.view));

/** The lab with that address. */
export function labLink({ runId, slug, view, from }: Address) {
  if (slug !== null) return linkOptions({ to: "/s/$id", params: { id: slug } });
  const search = searchOf(view);
  return runId === null
    ? linkOptions({ to: "/", search })
    : linkOptions({ to: "/r/$id", params: { id: runId }, search: from === undefined ? search : { ...search, from } });
}

/** What the address bar names of the lab, `null` on another page. */
function readAddress(router: RegisteredRouter): Address | null {
  const { pathname, search } = router.parseLocation(router.history.location);
  const [, { id = null }, route] = router.getMatchedRoutes(pathname);
  const { from, ...view } = readLabSearch(search);
  if (route?.id === "/lab/") return { ...START, view: viewOf(view) };
  if (route?.id === "/lab/r/$id")
    return { runId: id, slug: null, view: viewOf(view), ...(from !== undefined && { from }) };
  return route?.id === "/lab/s/$id" ? { ...START, slug: id } : null;
}

/** `opening` is how a lab is looked at that opens as it was left; what an address says goes before. */
export function createLabAddress(router: RegisteredRouter, opening = DEFAULT_VIEW) {
  const named = readAddress(router);
  const saysNothing = named === null || isSame(named, START);
  const store = createAtom<Address>(saysNothing ? { ...START, view: opening } : named);

  /** Where a link, back or forward led, until it is shown. */
  let pending: Address | null = null;
  /** The lab's address when the browser left it for another page, `null` while it is on one of the lab's. */
  let addressBeforeLeaving: Address | null = null;
  let isOpen = false;
  const current = () => pending ?? store.get();

  const write = (address: Address, replace: boolean) => {
    if (addressBeforeLeaving) return; // the address bar is another page's
    void router.navigate({ replace, resetScroll: false, state: { ofLab: true }, ...labLink(address) });
  };

  const readAddressBar = (listener: (address: Address) => void) => {
    const address = readAddress(router);
    if (address === null) {
      addressBeforeLeaving ??= current();
      return;
    }
    const before = addressBeforeLeaving;
    addressBeforeLeaving = null;
    if (isOpen && isSame(address, current())) return;
    // Back at the lab as it is: what has come of it meanwhile stays.
    if (isOpen && (isSame(address, START) || (before && isSame(address, before)))) write(current(), true);
    else {
      pending = address;
      isOpen = true;
      listener(address);
    }
  };

  return {
    /** The address of what the lab shows, on whichever page the browser is. */
    get: store.get,
    subscribe: store.subscribe,
    /** Shows another run; a new entry in the browser's history unless it is the same one. */
    showRun: (runId: string, view: Partial<View>, mode: "push" | "replace") => {
      const isSameRun = runId === current().runId;
      pending = null;
      store.set(({ from, view: before }) => ({
        runId,
        slug: null,
        view: { ...before, ...view },
        ...(from !== undefined && { from }),
      }));
      write(store.get(), isSameRun || mode === "replace");
    },
    /** The next run is no other page's: nothing leads back there. */
    clearFrom: () => store.set(({ runId, slug, view }) => ({ runId, slug, view })),
    /** Changes how the run is looked at; no new entry. */
    setView: (change: Partial<View>) => {
      const changed = (address: Address): Address => ({ ...address, view: { ...address.view, ...change } });
      store.set(changed);
      pending = pending && changed(pending);
      write(current(), true);
    },
    /** The address bar names something of the lab that is not shown: at once where it does so already. */
    onNavigate: (listener: (address: Address) => void) => {
      readAddressBar(listener);
      router.history.subscribe(({ location, action: { type } }) => {
        const isOwn = location.state.ofLab === true && (type === "PUSH" || type === "REPLACE");
        if (!isOwn) readAddressBar(listener);
      });
    },
    /** What the address bar names is shown now. */
    confirmNavigation: () => {
      if (pending) store.set(pending);
      pending = null;
    },
    /** What the address bar names is not waited for any more: it names again what is shown, as a new entry. */
    cancelNavigation: () => {
      if (pending === null) return;
      const { runId, slug } = pending;
      pending = null;
      const shown = store.get();
      write(shown, runId === shown.runId && slug === shown.slug);
    },
  };
}
