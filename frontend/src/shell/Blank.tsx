/** What the page shows in place of results: nothing chosen, nothing found, nothing yet. */

import { Box, Button, Skeleton, Stack, Text } from "@mantine/core";
import { useQueryClient } from "@tanstack/react-query";
import { Link } from "@tanstack/react-router";
import type { ReactNode } from "react";
import { useLabContext } from "../state/context";
import classes from "./shell.module.css";

interface Props {
  readonly title: string;
  readonly text: string;
  readonly children?: ReactNode;
}

export function Blank({ title, text, children }: Props) {
  return (
    <div className={classes.blank}>
      <svg width="180" height="46" viewBox="0 0 180 46" aria-hidden>
        <path d="M2 40h58c14 0 18-30 30-30s16 30 30 30h58" className={classes.blankRoad} />
      </svg>
      <Text component="h2" fw={650} size="lg" ta="center">
        {title}
      </Text>
      <Text c="dimmed" size="sm" maw={420} ta="center">
        {text}
      </Text>
      {children}
    </div>
  );
}

export function NothingChosen({ suggestion }: { readonly suggestion: readonly string[] }) {
  const { lab } = useLabContext();
  return (
    <Blank title="No strategy chosen" text="Switch on at least one above to see how the car rides.">
      <Button onClick={() => lab.setStrategies(suggestion)}>Show all strategies</Button>
    </Blank>
  );
}

export function NotFound() {
  const { lab, router } = useLabContext();
  const [title, text] =
    router.get().slug === null
      ? ["There is no run at this address", "The link may be incomplete, or the run was made on another server."]
      : ["There is no shared result at this address", "The link may be incomplete, or it was made on another server. Ask the sender for the complete address."];
  return (
    <Blank title={title} text={text}>
      <Button onClick={lab.openPaper}>Open the paper’s scenario</Button>
    </Blank>
  );
}

/** An address that is no page's. */
export function PageNotFound() {
  return (
    <Box component="main" p="1rem">
      <Blank title="There is no page at this address" text="The address may be incomplete. The navigation above leads to every page.">
        <Button renderRoot={(props) => <Link to="/" {...props} />}>Go to the lab</Button>
      </Blank>
    </Box>
  );
}

/** The last resort: a fault in drawing leaves the navigation and a way to load again instead of an empty page. */
export function PageFailed({ error }: { readonly error: unknown }) {
  return (
    <Box component="main" p="1rem" role="alert">
      <Blank title="This page has failed" text={`${error instanceof Error ? error.message : "Something went wrong"}. What was computed is stored at this address; loading it again shows it.`}>
        <Button onClick={() => window.location.reload()}>Load again</Button>
      </Blank>
    </Box>
  );
}

/** In place of the car and the plots. */
export function NoHistories({ reason }: { readonly reason: string }) {
  return (
    <Blank title="This result has no time histories" text={`${reason} The tables are as they were computed.`} />
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
      <Button onClick={onRetry ?? (() => void queries.refetchQueries())}>{retry}</Button>
    </Blank>
  );
}

/** The results' places before there are any: the same heights, so that nothing jumps. */
export function Loading() {
  return (
    <div className={classes.results} aria-busy aria-label="Loading results">
      <Skeleton h={150} radius={8} />
      <Skeleton h={66} radius={8} />
      <div className={classes.loadingGrid}>
        {Array.from({ length: 6 }, (_, index) => (
          <Skeleton key={index} height={210} radius={8} />
        ))}
      </div>
    </div>
  );
}

export function EditorLoading() {
  return (
    <Stack gap="0.9rem" p="1.2rem 1rem" aria-busy aria-label="Loading the form">
      {Array.from({ length: 9 }, (_, index) => (
        <Skeleton key={index} height={index % 4 === 0 ? 18 : 44} width={index % 4 === 0 ? "45%" : "100%"} radius="sm" />
      ))}
    </Stack>
  );
}
