/** Whether the server answers: one small store, written by every request, read by the banner. */

export type ConnectionState = "ok" | "down" | "busy";

type Listener = () => void;

function createConnection() {
  let state: ConnectionState = "ok";
  const listeners = new Set<Listener>();
  const set = (next: ConnectionState) => {
    if (next === state) return;
    state = next;
    for (const listener of listeners) listener();
  };
  return {
    get: () => state,
    subscribe: (listener: Listener) => {
      listeners.add(listener);
      return () => void listeners.delete(listener);
    },
    ok: () => set("ok"),
    lost: (kind: "down" | "busy") => set(kind),
  };
}

export const connection = createConnection();
