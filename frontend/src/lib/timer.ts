/** One restartable timeout. */

export interface Timer {
  readonly start: () => void;
  readonly stop: () => void;
  /** Acts now if it would have acted later. */
  readonly flush: () => void;
}

export function createTimer(delayMs: number, action: () => void): Timer {
  let handle: ReturnType<typeof setTimeout> | null = null;
  const stop = () => {
    if (handle !== null) clearTimeout(handle);
    handle = null;
  };
  const act = () => {
    handle = null;
    action();
  };
  return {
    start: () => {
      stop();
      handle = setTimeout(act, delayMs);
    },
    stop,
    flush: () => {
      if (handle === null) return;
      stop();
      action();
    },
  };
}
