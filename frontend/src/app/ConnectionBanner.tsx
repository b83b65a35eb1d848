/** Says when the server is away, asks again by itself, and brings back what was missing. */

import { Button, Text } from "@mantine/core";
import { useQueryClient } from "@tanstack/react-query";
import { IconPlugConnectedX } from "../ui/icons";
import { useCallback, useEffect, useEffectEvent, useState } from "react";
import { isTransient } from "../api/problem";
import { connection, probe, type Readiness, type Trouble } from "../api/connection";
import { useSelector } from "@tanstack/react-store";
import ui from "../ui/ui.module.css";

const FIRST_WAIT_S = 1;
const LONGEST_WAIT_S = 8;

const MESSAGE: Readonly<Record<Readiness, string>> = {
  down: "The server does not answer. Your edits are not lost.",
  starting: "The server is starting.",
  ready: "The server is busy. Your edits are not lost.",
};

/** `onBack` asks again for what queries do not hold. */
export function ConnectionBanner({ onBack }: { readonly onBack: () => void }) {
  const { trouble, wait } = useSelector(connection);
  const queries = useQueryClient();
  const isAway = trouble !== null;
  // Whichever request is answered first: the probe here, or one of a page.
  const askAgain = useEffectEvent(() => {
    onBack();
    void queries.refetchQueries({ predicate: ({ state }) => isTransient(state.error) });
  });
  useEffect(() => (isAway ? () => askAgain() : undefined), [isAway]);
  return trouble === null ? null : <Reconnecting trouble={trouble} requestedWait={wait} />;
}

interface Props {
  readonly trouble: Trouble;
  /** Seconds the server asked to wait. */
  readonly requestedWait: number;
}

function Reconnecting({ trouble, requestedWait }: Props) {
  const [attempt, setAttempt] = useState(0);
  const [wait, setWait] = useState(Math.max(FIRST_WAIT_S, requestedWait));
  const [readiness, setReadiness] = useState<Readiness>(trouble === "busy" ? "ready" : "down");

  const tryNow = useCallback(
    async (signal: AbortSignal) => {
      const answer = await probe(signal);
      if (signal.aborted) return;
      setReadiness(answer);
      if (answer === "ready") {
        connection.ok();
        return;
      }
      setAttempt((count) => count + 1);
      setWait(Math.min(LONGEST_WAIT_S, FIRST_WAIT_S * 2 ** attempt));
    },
    [attempt],
  );

  useEffect(() => {
    const controller = new AbortController();
    const tick = setTimeout(() => {
      if (wait <= 1) void tryNow(controller.signal);
      else setWait(wait - 1);
    }, 1000);
    return () => {
      clearTimeout(tick);
      controller.abort();
    };
  }, [wait, tryNow]);

  return (
    <div className={ui.notice} data-kind="trouble" data-testid="connection" role="status">
      <IconPlugConnectedX size={18} stroke={1.7} aria-hidden />
      <Text>
        {MESSAGE[readiness]} <span aria-hidden>Next try in {wait} s.</span>
      </Text>
      <Button size="compact-xs" onClick={() => void tryNow(new AbortController().signal)}>
        Try now
      </Button>
    </div>
  );
}
