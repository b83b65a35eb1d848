/** What stays from page to page: name, navigation, the colour scheme, and what is wrong with the connection. */

import { Link, Outlet } from "@tanstack/react-router";
import { useMemo, useState, lazy, type ReactNode, useCallback, useEffect, useEffectEvent } from "react";
import { Box, Button, Text } from "@mantine/core";
import { useLabContext } from "../lab/context";
import { Keyboard } from "./Keyboard";
import { Nav } from "./Nav";
import { SlotsContext } from "../ui/Page";
import classes from "../ui/shell.module.css";
import { Blank } from "../ui/Blank";
import ui from "../ui/ui.module.css";
import { tokenWanted, connection, probe, type Readiness, type Trouble } from "../api/connection";
import { useSelector } from "@tanstack/react-store";
import { LazyPart } from "../ui/LazyPart";
import { firstCurves } from "../lib/firstCurves";
import { useQueryClient } from "@tanstack/react-query";
import { IconPlugConnectedX } from "../ui/icons";
import { isTransient } from "../api/problem";

/** Not by an address with a fragment: the address belongs to what is shown. */
function focusMain() {
  const main = document.querySelector("main");
  main?.setAttribute("tabindex", "-1");
  main?.focus();
}

export function Shell() {
  const { lab } = useLabContext();
  const [tools, setTools] = useState<HTMLElement | null>(null);
  const [notices, setNotices] = useState<HTMLElement | null>(null);
  const slots = useMemo(() => ({ tools, notices }), [tools, notices]);
  return (
    <LoginGate>
      <SlotsContext value={slots}>
        <div className={classes.shell}>
          <button type="button" className={classes.skip} data-unprinted onClick={focusMain}>
            Skip to the page’s content
          </button>
          <header className={classes.header} data-unprinted>
            <Nav />
            <div className={classes.tools} ref={setTools} />
            <LazyPart>
              <HeaderEnd />
            </LazyPart>
          </header>
          <Outlet />
          <Keyboard />
          <div className={classes.notices} data-unprinted>
            <div className={classes.pageNotices} ref={setNotices} />
            <ConnectionBanner onBack={lab.resume} />
          </div>
        </div>
      </SlotsContext>
    </LoginGate>
  );
}

/** An address that is no page's. */
export function PageNotFound() {
  return (
    <Box component="main" p="1rem">
      <Blank
        title="There is no page at this address"
        text="The address may be incomplete. The navigation above leads to every page."
      >
        <Button size="sm" variant="filled" renderRoot={(props) => <Link to="/" {...props} />}>
          Go to the lab
        </Button>
      </Blank>
    </Box>
  );
}

/** The last resort: a fault in drawing leaves the navigation and a way to load again instead of an empty page. */
export function PageFailed({ error }: { readonly error: unknown }) {
  return (
    <Box component="main" p="1rem" role="alert">
      <Blank
        title="This page has failed"
        text={`${error instanceof Error ? error.message : "Something went wrong"}. What was computed is stored at this address; loading it again shows it.`}
      >
        <Button size="sm" variant="filled" onClick={() => window.location.reload()}>
          Load again
        </Button>
      </Blank>
    </Box>
  );
}

const OTHERS = { "/sweeps": "All sweeps", "/tuner": "New tuning", "/robustness": "New study" } as const;
export type JobLists = keyof typeof OTHERS;

interface JobNotFoundProps {
  /** What is shown, such as `sweep`. */
  readonly what: string;
  /** Where there are others. */
  readonly others: JobLists;
}

/** In place of a job's page. */
export function JobNotFound({ what, others }: JobNotFoundProps) {
  return (
    <Box component="main" p="1rem">
      <Blank
        title={`There is no ${what} at this address`}
        text={`The address may be incomplete, or the ${what} was made on another server.`}
      >
        <Button size="sm" variant="filled" renderRoot={(props) => <Link to={others} {...props} />}>
          {OTHERS[others]}
        </Button>
      </Blank>
    </Box>
  );
}

const HeaderEnd = lazy(async () => ({ default: (await firstCurves.then(() => import("./headerParts"))).HeaderEnd }));
const Login = lazy(async () => ({ default: (await import("./Login")).Login }));

/** The page, or what asks for a token where the service wants one. */
function LoginGate({ children }: { readonly children: ReactNode }) {
  if (!useSelector(tokenWanted)) {
    return children;
  }
  return (
    <LazyPart>
      <Login />
    </LazyPart>
  );
}

const FIRST_WAIT_S = 1;
const LONGEST_WAIT_S = 8;

const MESSAGE: Readonly<Record<Readiness, string>> = {
  down: "The server does not answer. Your edits are not lost.",
  starting: "The server is starting.",
  ready: "The server is busy. Your edits are not lost.",
};

/** `onBack` asks again for what queries do not hold. */
function ConnectionBanner({ onBack }: { readonly onBack: () => void }) {
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
