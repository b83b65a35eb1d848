/** Follows a batch by server-sent events until it has ended. */

import { api } from "./client";
import type { Batch } from "./types";

export type Progress = Pick<Batch, "state" | "done" | "failed" | "total">;

export const FINAL: readonly Batch["state"][] = ["done", "cancelled", "failed"];
export const isFinal = ({ state }: Pick<Batch, "state">) => FINAL.includes(state);

const RETRY_MS = 3000;

function isProgress(value: unknown): value is Progress {
  return typeof value === "object" && value !== null && "state" in value && "done" in value && "failed" in value && "total" in value;
}

function read(text: string): Progress | null {
  try {
    const value: unknown = JSON.parse(text);
    return isProgress(value) ? value : null;
  } catch {
    return null;
  }
}

interface Handlers {
  readonly onProgress: (progress: Progress) => void;
  /** Whether news arrive at the moment. */
  readonly onConnected: (connected: boolean) => void;
}

/**
 * The browser itself asks again from where a connection broke; only where the server refuses it has to be asked
 * anew, from the last number seen.
 */
export function followBatch(id: string, { onProgress, onConnected }: Handlers): () => void {
  let source: EventSource | null = null;
  let retry: ReturnType<typeof setTimeout> | undefined;
  let seen = 0;

  const receive = (event: MessageEvent<string>) => {
    seen = Number(event.lastEventId) || seen;
    const progress = read(event.data);
    if (progress === null) return;
    onProgress(progress);
    if (isFinal(progress)) source?.close();
  };
  const connect = () => {
    const made = new EventSource(api.batchEventsAddress(id, seen));
    source = made;
    made.addEventListener("open", () => onConnected(true));
    made.addEventListener("state", receive);
    made.addEventListener("progress", receive);
    made.addEventListener("error", () => {
      onConnected(false);
      if (made.readyState === EventSource.CLOSED) retry = setTimeout(connect, RETRY_MS);
    });
  };
  connect();
  return () => {
    clearTimeout(retry);
    source?.close();
  };
}
