/** What a measured road is called: a text of lists and sentences, where its id would say nothing. */

import { ownLibrary } from "./ownLibrary";

/** Its name in this browser's library; a road that is not in it has none. */
export function roadName(id: string): string {
  return ownLibrary.get().find(({ kind, value }) => kind === "road" && value.id === id)?.name ?? "a measured road";
}
