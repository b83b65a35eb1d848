/** One request at a time; while it runs only the newest wish waits, and what was overtaken is dropped. */

export interface Latest<Wish> {
  readonly request: (wish: Wish) => void;
  /** Aborts what runs and forgets what waits. */
  readonly cancel: () => void;
}

interface Handlers<Wish, Answer> {
  readonly run: (wish: Wish, signal: AbortSignal) => Promise<Answer>;
  readonly onAnswer: (answer: Answer, wish: Wish) => void;
  readonly onError: (error: unknown, wish: Wish) => void;
}

export function createLatest<Wish, Answer>({ run, onAnswer, onError }: Handlers<Wish, Answer>): Latest<Wish> {
  let running: AbortController | null = null;
  let waiting: { readonly wish: Wish } | null = null;

  const finish = (controller: AbortController) => {
    if (running !== controller) return;
    running = null;
    const next = waiting;
    waiting = null;
    if (next) start(next.wish);
  };

  const start = (wish: Wish) => {
    const controller = new AbortController();
    running = controller;
    run(wish, controller.signal)
      .then(
        (answer) => {
          if (running === controller) onAnswer(answer, wish);
        },
        (error: unknown) => {
          if (running === controller) onError(error, wish);
        },
      )
      .finally(() => finish(controller));
  };

  return {
    request: (wish) => {
      if (running) waiting = { wish };
      else start(wish);
    },
    cancel: () => {
      running?.abort();
      running = null;
      waiting = null;
    },
  };
}
