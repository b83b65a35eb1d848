/** Which section is being read. */

import { useEffect, useState } from "react";

/** A heading counts as reached when it is this near to the window's top [px]. */
const REACHED = 120;

/** Index of the last of these elements whose top has been reached; 0 above the first. */
export function useSection(ids: readonly string[]): number {
  const [section, setSection] = useState(0);
  useEffect(() => {
    let frame = 0;
    const look = () => {
      frame = 0;
      const tops = ids.map((id) => document.getElementById(id)?.getBoundingClientRect().top ?? Infinity);
      const atEnd = window.innerHeight + window.scrollY >= document.documentElement.scrollHeight - 2;
      setSection(
        atEnd && window.scrollY > 0
          ? ids.length - 1
          : Math.max(
              0,
              tops.findLastIndex((top) => top < REACHED),
            ),
      );
    };
    const onScroll = () => {
      if (frame === 0) frame = requestAnimationFrame(look);
    };
    window.addEventListener("scroll", onScroll, { passive: true });
    return () => {
      window.removeEventListener("scroll", onScroll);
      cancelAnimationFrame(frame);
    };
  }, [ids]);
  return section;
}
