/** One request at a time; while it runs only the newest input waits, and what was overtaken is dropped. */

export interface Latest<Input> {
  readonly request: (input: Input) => void;
  /** Aborts what runs and forgets what waits. */
  readonly cancel: () => void;
}

interface Handlers<Input, Answer> {
  readonly run: (input: Input, signal: AbortSignal) => Promise<Answer>;
  readonly onAnswer: (answer: Answer, input: Input) => void;
  readonly onError: (error: unknown, input: Input) => void;
}

export function createLatest<Input, Answer>({ run, onAnswer, onError }: Handlers<Input, Answer>): Latest<Input> {
  let running: AbortController | null = null;
  let waiting: { readonly input: Input } | null = null;

  const finish = (controller: AbortController) => {
    if (running !== controller) return;
    running = null;
    const next = waiting;
    waiting = null;
    if (next) start(next.input);
  };

  const start = (input: Input) => {
    const controller = new AbortController();
    running = controller;
    run(input, controller.signal)
      .then(
        (answer) => {
          if (running === controller) onAnswer(answer, input);
        },
        (error: unknown) => {
          if (running === controller) onError(error, input);
        },
      )
      .finally(() => finish(controller));
  };

  return {
    request: (input) => {
      if (running) waiting = { input };
      else start(input);
    },
    cancel: () => {
      running?.abort();
      running = null;
      waiting = null;
    },
  };
}
