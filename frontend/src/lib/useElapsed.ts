/** For how long somebody has been waiting. */

import { useEffect, useState } from "react";

/** [s] since it is shown, anew so often. */
export function useElapsed(everyMs: number): number {
  const [seconds, setSeconds] = useState(0);
  useEffect(() => {
    const begin = performance.now();
    const timer = setInterval(() => setSeconds((performance.now() - begin) / 1000), everyMs);
    return () => clearInterval(timer);
  }, [everyMs]);
  return seconds;
}
