/** Whether the service wants a token before it answers; most never do. */

import { createStore } from "../state/store";
import { readProblem, Unreachable } from "./problem";

const wanted = createStore(false);

export const login = {
  wanted: wanted.get,
  subscribe: wanted.subscribe,
  /** A request was refused for want of a token. */
  want: () => wanted.set(true),

  /** Has the service set its cookie, which event streams and downloads send along. */
  send: async (token: string): Promise<void> => {
    let response: Response;
    try {
      response = await fetch("/api/v1/login", {
        method: "POST",
        headers: { "content-type": "application/json" },
        body: JSON.stringify({ token }),
      });
    } catch {
      throw new Unreachable();
    }
    if (!response.ok) throw readProblem(response.status, await response.json().catch(() => null), response.headers.get("retry-after"));
  },
};
