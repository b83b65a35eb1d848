/** What the page asks for, and what stands in its place until it is there, or could not be computed. */

import { Button, Group, Loader, Text } from "@mantine/core";
import { type UseQueryResult, keepPreviousData, queryOptions } from "@tanstack/react-query";
import { useState, type ReactNode, useEffect } from "react";
import { useIntersection } from "@mantine/hooks";
import { printing } from "../../lib/printing";
import { useSelector } from "@tanstack/react-store";
import ui from "../../ui/ui.module.css";
import { Note } from "../../ui/Messages";
import { ask, query } from "../../api/http";
import { type PaperFigure } from "../../api/types";
import { type Choices } from "./choices";

interface WaitingProps {
  readonly what: string;
  /** As high as what comes [px]. */
  readonly height: number;
}

/** The first time takes a while: somebody who waits sees that it goes on. */
const TELL_AFTER_S = 2;

export function Waiting({ what, height }: WaitingProps) {
  const seconds = Math.floor(useElapsed(1000));
  return (
    <Group className={ui.card ?? ""} justify="center" align="start" mih={height} p="3rem 1rem" data-unprinted aria-busy>
      <Group gap="0.9rem" align="start" wrap="nowrap" maw="32rem" pos="sticky" top="40vh">
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
      </Group>
    </Group>
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

interface AnsweredProps<Data> extends Pick<WaitingProps, "height"> {
  readonly query: Pick<UseQueryResult<Data>, "data" | "error" | "refetch">;
  /** What is being done meanwhile. */
  readonly waiting: string;
  readonly children: (data: Data) => ReactNode;
}

/** What an answer shows, once it is there. */
export function Answered<Data>({ query: { data, error, refetch }, waiting, height, children }: AnsweredProps<Data>) {
  if (data !== undefined) return children(data);
  if (error) return <Fault message={error.message} onRetry={() => void refetch()} />;
  return <Waiting key={waiting} what={waiting} height={height} />;
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

const UNCHANGING = { staleTime: Infinity, gcTime: 30 * 60_000 } as const;
/** Rows that are still being computed are asked for again after this [ms]. */
const AGAIN_AFTER = 1_000;
const untilComplete = ({ state }: { readonly state: { readonly data?: { readonly complete: boolean } | undefined } }) =>
  state.data?.complete === false && AGAIN_AFTER;

/** Only the roads concern what the switches do not. */
const roadsOf = ({ seeds, first_seed }: Choices): Choices => ({
  ...(seeds !== undefined && { seeds }),
  ...(first_seed !== undefined && { first_seed }),
});

export const paperQuery = (choices: Choices) => ({
  ...query("/paper", { query: { ...choices, partial: true } }),
  placeholderData: keepPreviousData,
  refetchInterval: untilComplete,
  ...UNCHANGING,
  staleTime: ({ state }: { readonly state: { readonly data?: { readonly unavailable: unknown } | undefined } }) =>
    state.data?.unavailable ? 0 : Infinity,
});

export const effectsQuery = (choices: Choices) => ({
  ...query("/paper/readings", { query: roadsOf(choices) }),
  refetchInterval: untilComplete,
  ...UNCHANGING,
});

export const attributionQuery = (choices: Choices) => ({
  ...query("/paper/attribution", { query: roadsOf(choices) }),
  ...UNCHANGING,
});

export const paperFiguresQuery = (choices: Choices) =>
  queryOptions({
    queryKey: ["paper figures", roadsOf(choices)],
    // plotly's own JSON, which the API's description leaves open
    queryFn: async ({ signal }) =>
      (await ask("get", "/paper/figures", { query: roadsOf(choices) }, signal))
        .figures as unknown as readonly PaperFigure[],
    ...UNCHANGING,
  });

/** [s] since it is shown, anew so often. */
function useElapsed(everyMs: number): number {
  const [seconds, setSeconds] = useState(0);
  useEffect(() => {
    const begin = performance.now();
    const timer = setInterval(() => setSeconds((performance.now() - begin) / 1000), everyMs);
    return () => clearInterval(timer);
  }, [everyMs]);
  return seconds;
}
