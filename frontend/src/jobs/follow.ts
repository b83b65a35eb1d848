/** Follows a job by its server-sent events. */

import type { Batch } from "../api/types";

/** What every event says. */
export type JobEvent = Pick<Batch, "state" | "done" | "failed" | "total">;

const FINAL: readonly Batch["state"][] = ["done", "cancelled", "failed"];
export const isFinal = ({ state }: Pick<Batch, "state">) => FINAL.includes(state);

const EVENTS = ["state", "progress", "restart"];
const RETRY_MS = 3000;

const isJobEvent = (value: unknown): value is JobEvent =>
  typeof value === "object" &&
  value !== null &&
  "state" in value &&
  "done" in value &&
  "failed" in value &&
  "total" in value;

function read(text: string): JobEvent | null {
  try {
    const value: unknown = JSON.parse(text);
    return isJobEvent(value) ? value : null;
  } catch {
    return null;
  }
}

export interface Handlers {
  readonly onEvent: (event: JobEvent) => void;
  /** Whether events can arrive at the moment. */
  readonly onConnected: (connected: boolean) => void;
}

/**
 * From the first event on, until the returned function is called: the events of a resumed job go on behind a final
 * state. The browser itself asks again from where a connection broke; only where the server refuses it has to be asked
 * anew, from the last number seen.
 */
export function follow(address: (after: number) => string, { onEvent, onConnected }: Handlers): () => void {
  let source: EventSource | null = null;
  let retry: ReturnType<typeof setTimeout> | undefined;
  let [lastEvent, ended] = [0, false];

  const receive = ({ data, lastEventId }: MessageEvent<string>) => {
    lastEvent = Number(lastEventId) || lastEvent;
    const event = read(data);
    if (event === null) return;
    ended = isFinal(event);
    onEvent(event);
  };
  const connect = () => {
    const opened = new EventSource(address(lastEvent));
    source = opened;
    opened.addEventListener("open", () => onConnected(true));
    for (const name of EVENTS) opened.addEventListener(name, receive);
    opened.addEventListener("error", () => {
      // Behind a final state the server itself ends the stream.
      if (!ended) onConnected(false);
      if (opened.readyState === EventSource.CLOSED) retry = setTimeout(connect, RETRY_MS);
    });
  };
  connect();
  return () => {
    clearTimeout(retry);
    source?.close();
  };
}
