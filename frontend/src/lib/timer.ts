/** One restartable timeout. */

export type Timer = ReturnType<typeof createTimer>;

export function createTimer(delayMs: number, action: () => void) {
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
  };
}
