/** The library of this browser. */

import { createStore, useStore } from "../lib/store";
import { ownStorage } from "../lib/storage";
import { createLibrary, type Item, type Kind } from "./library";

export const ownLibrary = createLibrary(ownStorage());

/** What the open dialog offers to save; `null` while it is closed. */
export const dialog = createStore<Exclude<Kind, "road"> | null>(null);

export function useItems(kind: Kind): readonly Item[] {
  return useStore(ownLibrary).filter((item) => item.kind === kind);
}
