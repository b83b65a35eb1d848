/** One restartable timeout. */

export interface Timer {
  readonly start: () => void;
  readonly stop: () => void;
}

export function createTimer(delayMs: number, action: () => void): Timer {
  let handle: ReturnType<typeof setTimeout> | null = null;
  const stop = () => {
    if (handle !== null) clearTimeout(handle);
    handle = null;
  };
  return {
    start: () => {
      stop();
      handle = setTimeout(action, delayMs);
    },
    stop,
  };
}
