/** The end of changes that no release of a pointer ends. */

import { useEffect, useEffectEvent, useRef } from "react";
import { createTimer } from "./timer";

const KEY_PAUSE_MS = 350;

/** Changes made with keys or by assistive technology: a pause ends them, and so does leaving the control. */
export function useReleaseAfterKeys(release: () => void) {
  const timer = useRef<ReturnType<typeof createTimer>>(null);
  const end = useEffectEvent(() => release());
  useEffect(() => {
    const own = createTimer(KEY_PAUSE_MS, () => end());
    timer.current = own;
    return own.flush;
  }, []);
  return {
    begin: () => timer.current?.start(),
    stop: () => timer.current?.stop(),
    flush: () => timer.current?.flush(),
  };
}
