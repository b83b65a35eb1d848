/** Whether the page is being printed: then everything is drawn, in sight or not. */

import { flushSync } from "react-dom";
import { createAtom } from "@tanstack/react-store";

const store = createAtom(false);

export const printing = { get: store.get, subscribe: store.subscribe };

/** The browser takes its picture when the event's listeners have returned, so they have to have drawn by then. */
export function watchPrinting(): void {
  window.addEventListener("beforeprint", () => flushSync(() => store.set(true)));
  window.addEventListener("afterprint", () => store.set(false));
}
