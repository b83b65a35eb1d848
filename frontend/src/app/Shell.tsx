/** What stays from page to page: name, navigation, the colour scheme, and what is wrong with the connection. */

import { Link, Outlet, useRouter } from "@tanstack/react-router";
import { type ComponentProps, useMemo, useState, lazy, useCallback, useEffect, useEffectEvent } from "react";
import { Box, Button, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useLabContext } from "../lab/context";
import { Keyboard } from "./Keyboard";
import { Nav } from "./Nav";
import { SlotsContext, Blank } from "../ui/Page";
import classes from "../ui/shell.module.css";
import ui from "../ui/ui.module.css";
import { tokenWanted, connection, probe, type Connection, type Readiness } from "../api/connection";
import { useSelector } from "@tanstack/react-store";
import { LazyPart } from "../ui/LazyPart";
import { firstCurves } from "../lib/firstCurves";
import { useQueryClient } from "@tanstack/react-query";
import { Icon } from "../ui/icons";
import { ApiProblem, isTransient, messageOf } from "../api/problem";

/** Not by an address with a fragment: the address belongs to what is shown. */
function focusMain() {
  const main = document.querySelector("main");
  main?.setAttribute("tabindex", "-1");
  main?.focus();
}

export function Shell() {
  const [tools, setTools] = useState<HTMLElement | null>(null);
  const [notices, setNotices] = useState<HTMLElement | null>(null);
  const slots = useMemo(() => ({ tools, notices }), [tools, notices]);
  if (useSelector(tokenWanted))
    return (
      <LazyPart>
        <Login />
      </LazyPart>
    );
  return (
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
          <div style={{ display: "contents" }} ref={setNotices} />
          <ConnectionBanner />
        </div>
      </div>
    </SlotsContext>
  );
}

interface InPlaceOfPageProps extends ComponentProps<typeof Blank> {
  readonly role?: "alert";
}

function InPlaceOfPage({ role, ...props }: InPlaceOfPageProps) {
  useDocumentTitle(`${props.title} · Ridelab`);
  return (
    <Box component="main" p="1rem" {...(role && { role })}>
      <Blank {...props} />
    </Box>
  );
}

/** A link to another page. */
export interface WayOn {
  readonly to: "/" | "/sweeps" | "/tuner" | "/robustness";
  readonly label: string;
}

interface NothingHereProps {
  /** What the address should lead to, such as `sweep`. */
  readonly what: string;
  readonly text?: string;
  readonly wayOn: WayOn;
}

/** In place of what is not at the address. */
export function NothingHere({
  what,
  text = `The address may be incomplete, or the ${what} was made on another server.`,
  wayOn: { to, label },
}: NothingHereProps) {
  return (
    <InPlaceOfPage title={`There is no ${what} at this address`} text={text}>
      <Button size="sm" variant="filled" renderRoot={(props) => <Link to={to} {...props} />}>
        {label}
      </Button>
    </InPlaceOfPage>
  );
}

export const PageNotFound = () => (
  <NothingHere
    what="page"
    text="The address may be incomplete. The navigation above leads to every page."
    wayOn={{ to: "/", label: "Go to the lab" }}
  />
);

/**
 * The last resort leaves the navigation. What the server refused is asked for again; after a fault in drawing the page is
 * loaded again.
 */
export function PageFailed({ error }: { readonly error: unknown }) {
  const router = useRouter();
  const isRefused = error instanceof ApiProblem;
  const text = isRefused
    ? error.message
    : `${messageOf(error)}. What was computed is stored at this address; loading it again shows it.`;
  return (
    <InPlaceOfPage
      role="alert"
      title={isRefused ? "This page could not be shown" : "This page has failed"}
      text={text}
      action={
        isRefused
          ? { label: "Try again", onClick: () => void router.invalidate() }
          : { label: "Load again", onClick: () => window.location.reload() }
      }
    />
  );
}

const HeaderEnd = lazy(async () => ({ default: (await firstCurves.then(() => import("./headerParts"))).HeaderEnd }));
const Login = lazy(async () => ({ default: (await import("./Login")).Login }));

const FIRST_WAIT_S = 1;
const LONGEST_WAIT_S = 8;

const MESSAGE: Readonly<Record<Readiness, string>> = {
  down: "The server does not answer. Your edits are not lost.",
  starting: "The server is starting.",
  ready: "The server is busy. Your edits are not lost.",
};

function ConnectionBanner() {
  const { lab } = useLabContext();
  const { trouble, wait } = useSelector(connection);
  const queries = useQueryClient();
  const isAway = trouble !== null;
  // Whichever request is answered first: the probe here, or one of a page.
  const askAgain = useEffectEvent(() => {
    lab.resume(); // for what queries do not hold
    void queries.refetchQueries({ predicate: ({ state }) => isTransient(state.error) });
  });
  useEffect(() => (isAway ? () => askAgain() : undefined), [isAway]);
  return trouble === null ? null : <Reconnecting {...{ trouble, wait }} />;
}

function Reconnecting({ trouble, wait: requestedWait }: Connection) {
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
      <Icon name="PlugConnectedX" size={18} stroke={1.7} />
      <Text>
        {MESSAGE[readiness]} <span aria-hidden>Next try in {wait} s.</span>
      </Text>
      <Button size="compact-xs" onClick={() => void tryNow(new AbortController().signal)}>
        Try now
      </Button>
    </div>
  );
}
