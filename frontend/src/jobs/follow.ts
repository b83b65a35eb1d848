/** Follows a job by its server-sent events. */

import type { Batch } from "../api/types";

/** What every event says. */
export type News = Pick<Batch, "state" | "done" | "failed" | "total">;

const FINAL: readonly Batch["state"][] = ["done", "cancelled", "failed"];
export const isFinal = ({ state }: Pick<Batch, "state">) => FINAL.includes(state);

const EVENTS = ["state", "progress", "restart"];
const RETRY_MS = 3000;

const isNews = (value: unknown): value is News =>
  typeof value === "object" && value !== null && "state" in value && "done" in value && "failed" in value && "total" in value;

function read(text: string): News | null {
  try {
    const value: unknown = JSON.parse(text);
    return isNews(value) ? value : null;
  } catch {
    return null;
  }
}

interface Handlers {
  readonly onNews: (news: News) => void;
  /** Whether news arrive at the moment. */
  readonly onConnected: (connected: boolean) => void;
}

/**
 * From the first event on, until the returned function is called: the events of a resumed job go on behind a final
 * state. The browser itself asks again from where a connection broke; only where the server refuses it has to be asked
 * anew, from the last number seen.
 */
export function follow(address: (after: number) => string, { onNews, onConnected }: Handlers): () => void {
  let source: EventSource | null = null;
  let retry: ReturnType<typeof setTimeout> | undefined;
  let [seen, ended] = [0, false];

  const receive = (event: MessageEvent<string>) => {
    seen = Number(event.lastEventId) || seen;
    const news = read(event.data);
    if (news === null) return;
    ended = isFinal(news);
    onNews(news);
  };
  const connect = () => {
    const opened = new EventSource(address(seen));
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
