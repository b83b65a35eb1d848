/** One restartable timeout. */
export function createTimer(delayMs: number, action: () => void) {
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
