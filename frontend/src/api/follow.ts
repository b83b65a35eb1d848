/** Follows what the server works on by server-sent events. */

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

interface Handlers<News> {
  readonly onProgress: (progress: News) => void;
  /** Whether news arrive at the moment. */
  readonly onConnected: (connected: boolean) => void;
}

interface Stream<News> {
  readonly address: (after: number) => string;
  readonly events: readonly string[];
  /** `null` for what cannot be read. */
  readonly read: (text: string) => News | null;
  /** Nothing comes after this. */
  readonly isLast: (news: News) => boolean;
}

/**
 * The browser itself asks again from where a connection broke; only where the server refuses it has to be asked
 * anew, from the last number seen.
 */
export function follow<News>({ address, events, read, isLast }: Stream<News>, { onProgress, onConnected }: Handlers<News>): () => void {
  let source: EventSource | null = null;
  let retry: ReturnType<typeof setTimeout> | undefined;
  let seen = 0;

  const receive = (event: MessageEvent<string>) => {
    seen = Number(event.lastEventId) || seen;
    const news = read(event.data);
    if (news === null) return;
    onProgress(news);
    if (isLast(news)) source?.close();
  };
  const connect = () => {
    const made = new EventSource(address(seen));
    source = made;
    made.addEventListener("open", () => onConnected(true));
    for (const name of events) made.addEventListener(name, receive);
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

export const followBatch = (id: string, handlers: Handlers<Progress>) =>
  follow({ address: (after) => api.batchEventsAddress(id, after), events: ["state", "progress"], read, isLast: isFinal }, handlers);
