/** One exact request at a time: a new one aborts the one before, so that a stale answer never lands. */

import { isAbort, isTransient } from "../api/problem";
import type { LabState } from "./labState";
import { hasErrors, NO_ERRORS } from "./problems";
import type { Atom } from "@tanstack/react-store";
import type { Timer } from "../lib/timer";

export interface ExactRequest {
  readonly work: (signal: AbortSignal, isCurrent: () => boolean) => Promise<void>;
  /** Asks for the same once more. */
  readonly again: () => void;
  /** What else to do where it fails for good. */
  readonly giveUp?: () => void;
}

export interface ExactRequests {
  readonly start: (request: ExactRequest) => void;
  /** Aborts what runs. */
  readonly cancel: () => void;
}

interface Parts {
  readonly store: Atom<LabState>;
  /** Marks what is shown as stale when it ends. */
  readonly grace: Timer;
  readonly onError: (error: unknown, again: () => void) => void;
}

export function createExactRequests({ store, grace, onError }: Parts): ExactRequests {
  let current: AbortController | null = null;
  const patch = (change: Partial<LabState>) => store.set((state) => ({ ...state, ...change }));

  return {
    start: ({ work, again, giveUp }) => {
      current?.abort();
      const controller = new AbortController();
      current = controller;
      const isCurrent = () => current === controller;
      patch({ busy: true, failure: null, serverErrors: NO_ERRORS });
      grace.start();
      work(controller.signal, isCurrent)
        .catch((error: unknown) => {
          if (!isCurrent()) return;
          if (!isAbort(error) && !isTransient(error)) giveUp?.();
          onError(error, again);
        })
        .finally(() => {
          if (!isCurrent()) return;
          current = null;
          grace.stop();
          // After a failure the old curves stay dimmed: they are not what the form says.
          patch({ busy: false, stale: store.get().failure !== null || hasErrors(store.get().serverErrors) });
        });
    },
    cancel: () => {
      if (current === null) return;
      current.abort();
      current = null;
      grace.stop();
    },
  };
}
