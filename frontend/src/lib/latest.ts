/** A few requests at a time; while they run only the newest input waits, and what was overtaken is dropped. */

import { useEffect, useState } from "react";
import { isTransient } from "../api/problem";

interface Handlers<Input, Answer> {
  readonly run: (input: Input, signal: AbortSignal) => Promise<Answer>;
  readonly onAnswer: (answer: Answer, input: Input) => void;
  readonly onError: (error: unknown, input: Input) => void;
  /** So many may run, one where it is not said: with two the next is computed while the last is sent and drawn. */
  readonly most?: number;
}

export function createLatest<Input, Answer>({ run, onAnswer, onError, most = 1 }: Handlers<Input, Answer>) {
  /** The oldest first. */
  let running: readonly AbortController[] = [];
  let waiting: { readonly input: Input } | null = null;

  const start = (input: Input) => {
    const controller = new AbortController();
    running = [...running, controller];
    const end = (act: () => void) => {
      const place = running.indexOf(controller);
      if (place < 0) return;
      for (const overtaken of running.slice(0, place)) overtaken.abort();
      running = running.slice(place + 1);
      const next = waiting;
      waiting = null;
      if (next) start(next.input);
      act();
    };
    run(input, controller.signal).then(
      (answer) => end(() => onAnswer(answer, input)),
      (error: unknown) => end(() => onError(error, input)),
    );
  };

  return {
    request: (input: Input) => {
      if (running.length >= most) waiting = { input };
      else start(input);
    },
    /** Aborts what runs and forgets what waits. */
    cancel: () => {
      for (const controller of running) controller.abort();
      running = [];
      waiting = null;
    },
  };
}

/** What the server says of something that changes faster than it answers.
 *
 * One question at a time; what was overtaken is not shown. `ask` depends on its input alone. */
export function useLatest<Input, Answer>(ask: (input: Input, signal: AbortSignal) => Promise<Answer>) {
  const [shown, setShown] = useState<{
    /** The last there was. */
    readonly answer: Answer | null;
    /** Why the newest question has none. */
    readonly error: Error | null;
  }>({ answer: null, error: null });
  const [latest] = useState(() =>
    createLatest<Input, Answer>({
      run: ask,
      onAnswer: (answer) => setShown({ answer, error: null }),
      onError: (error) => {
        if (error instanceof Error && !isTransient(error)) setShown(({ answer }) => ({ answer, error }));
      },
    }),
  );
  useEffect(() => latest.cancel, [latest]);
  return { ...shown, ...latest };
}
