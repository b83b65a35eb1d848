/** What the page shows in place of results: nothing chosen, nothing found, nothing yet. */

import { Button, Text, Skeleton } from "@mantine/core";
import { useQueryClient } from "@tanstack/react-query";
import type { ReactNode } from "react";
import classes from "./shell.module.css";
import ui from "./ui.module.css";

interface Props {
  readonly title: string;
  readonly text: string;
  readonly children?: ReactNode;
}

export function Blank({ title, text, children }: Props) {
  return (
    <div className={`${ui.card} ${classes.blank}`}>
      <svg width="180" height="46" viewBox="0 0 180 46" aria-hidden>
        <path d="M2 40h58c14 0 18-30 30-30s16 30 30 30h58" className={classes.blankRoad} />
      </svg>
      <Text component="h2" fw={650} size="lg" ta="center">
        {title}
      </Text>
      <Text c="dimmed" maw={420} ta="center">
        {text}
      </Text>
      {children}
    </div>
  );
}

interface Failure {
  readonly what?: string;
  readonly message: string;
  readonly onRetry?: () => void;
  readonly retry?: string;
}

export function CouldNotLoad({ what = "page", message, onRetry, retry = "Try again" }: Failure) {
  const queries = useQueryClient();
  return (
    <Blank title={`This ${what} could not be shown`} text={message}>
      <Button size="sm" variant="filled" onClick={onRetry ?? (() => void queries.refetchQueries())}>
        {retry}
      </Button>
    </Blank>
  );
}

/** The places of what is on its way. */
export function Loading({ label, heights }: { readonly label: string; readonly heights: readonly number[] }) {
  return (
    <div className={ui.stack} aria-busy aria-label={label}>
      {heights.map((height, index) => (
        <Skeleton key={index} height={height} radius={8} />
      ))}
    </div>
  );
}
