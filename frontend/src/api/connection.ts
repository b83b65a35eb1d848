/** Whether the server answers: one small store, written by every request, read by the banner. */

import { createAtom } from "@tanstack/react-store";

export type Trouble = "down" | "busy";

export interface Connection {
  readonly trouble: Trouble | null;
  /** How long the server asked to be left alone [s]. */
  readonly wait: number;
}

const FINE: Connection = { trouble: null, wait: 0 };
const store = createAtom<Connection>(FINE);

export const connection = {
  get: store.get,
  subscribe: store.subscribe,
  ok: () => store.set(FINE),
  lost: (trouble: Trouble, wait = 0) => store.set({ trouble, wait }),
};

export type Readiness = "ready" | "starting" | "down";

/** Asks whether the server can work; never throws. */
export async function probe(signal: AbortSignal): Promise<Readiness> {
  try {
    const response = await fetch("/readyz", { signal, cache: "no-store" });
    if (response.ok) return "ready";
    return response.status === 503 ? "starting" : "down";
  } catch {
    return "down";
  }
}

/** Whether a request was refused for want of a token. */
export const tokenWanted = createAtom(false);
