/** In place of a part of the page that is still being computed, or could not be. */

import { Button, Loader, Text } from "@mantine/core";
import { useEffect, useState } from "react";
import { useIntersection } from "@mantine/hooks";
import classes from "./paper.module.css";
import { printing } from "../../lib/printing";
import { useSelector } from "@tanstack/react-store";
import ui from "../../ui/ui.module.css";
import { Note } from "../../ui/Messages";

interface WaitingProps {
  readonly what: string;
  /** As high as what comes [px]. */
  readonly height: number;
}

/** The first time takes a while: somebody who waits sees that it goes on. */
const TELL_AFTER_S = 2;

export function Waiting({ what, height }: WaitingProps) {
  const [seconds, setSeconds] = useState(0);
  useEffect(() => {
    const tick = setInterval(() => setSeconds((before) => before + 1), 1000);
    return () => clearInterval(tick);
  }, []);
  return (
    <div className={classes.waiting} style={{ minHeight: height }} aria-busy>
      <div className={classes.waitingText}>
        <Loader size="sm" />
        <div>
          <Text fw={600} role="status">
            {what} …
          </Text>
          <Note>
            {seconds >= TELL_AFTER_S ? `${seconds} s so far. ` : ""}The first time takes up to a minute; after that it
            is stored.
          </Note>
        </div>
      </div>
    </div>
  );
}

export function Fault({ message, onRetry }: { readonly message: string; readonly onRetry: () => void }) {
  return (
    <div className={ui.banner} role="alert">
      <Text>{message}</Text>
      <Button onClick={onRetry}>Try again</Button>
    </div>
  );
}

/** What is this near to the window is as good as in it. */
const NEAR = "300px 0px";

/** Whether a part of the page has come near the window, or is being printed; once so, always so. */
export function useVisible() {
  const { ref, entry } = useIntersection<HTMLElement>({ rootMargin: NEAR });
  const printed = useSelector(printing);
  const [visible, setVisible] = useState(false);
  if (!visible && (printed || entry?.isIntersecting === true)) setVisible(true);
  return { ref, visible, printed };
}
