/** One restartable timeout. */

import { useDebouncedCallback } from "@mantine/hooks";

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

/** The end of changes that no release of a pointer ends. */
const KEY_PAUSE_MS = 350;

/** Changes made with keys or by assistive technology: a pause ends them, and so does leaving the control. */
export const useReleaseAfterKeys = (release: () => void) =>
  useDebouncedCallback(release, { delay: KEY_PAUSE_MS, flushOnUnmount: true });
