/** A few requests at a time; while they run only the newest input waits, and what was overtaken is dropped. */

export interface Latest<Input> {
  readonly request: (input: Input) => void;
  /** Aborts what runs and forgets what waits. */
  readonly cancel: () => void;
}

interface Handlers<Input, Answer> {
  readonly run: (input: Input, signal: AbortSignal) => Promise<Answer>;
  readonly onAnswer: (answer: Answer, input: Input) => void;
  readonly onError: (error: unknown, input: Input) => void;
  /** So many may run, one where it is not said: with two the next is computed while the last is sent and drawn. */
  readonly most?: number;
}

export function createLatest<Input, Answer>({
  run,
  onAnswer,
  onError,
  most = 1,
}: Handlers<Input, Answer>): Latest<Input> {
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
    request: (input) => {
      if (running.length >= most) waiting = { input };
      else start(input);
    },
    cancel: () => {
      for (const controller of running) controller.abort();
      running = [];
      waiting = null;
    },
  };
}
