import { useEffect, useRef, useState } from "react";
import { copyText } from "../lib/clipboard";

const SHOWN_MS = 1600;

/** Copies, and tells for a moment that it has; where copying is refused, `onRefused` gets the text. */
export function useCopied(onRefused?: (text: string) => void) {
  const [copied, setCopied] = useState(false);
  const timer = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  useEffect(() => () => clearTimeout(timer.current), []);
  return {
    copied,
    copy: (text: string) => {
      void copyText(text).then((done) => {
        setCopied(done);
        if (!done) onRefused?.(text);
        clearTimeout(timer.current);
        timer.current = setTimeout(() => setCopied(false), SHOWN_MS);
      });
    },
  };
}
