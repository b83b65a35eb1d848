/** What stays from page to page: name, navigation, the colour scheme, and what is wrong with the connection. */

import { Link, Outlet, useRouter, linkOptions, useNavigate, useRouterState, useSearch } from "@tanstack/react-router";
import { type ComponentProps, useMemo, useState, lazy, useCallback, useEffect, useEffectEvent, useRef } from "react";
import { Box, Button, Text, Group } from "@mantine/core";
import { useDocumentTitle, useWindowEvent } from "@mantine/hooks";
import { useLabContext, useLab } from "../lab/context";
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
import { MANUAL } from "../ui/manual";
import { type Address } from "../lab/address";
import { usePaletteEntries, ACTION_IDS, ACTIONS, canRun, isKeyOn, runAction, useAction } from "../lab/actions";
import { labLink } from "../lab/labAddress";

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

/** Navigation between the pages: links where there is room, else a menu under the name of the page shown. */
const PagesMenu = lazy(async () => ({ default: (await firstCurves.then(() => import("./headerParts"))).PagesMenu }));

/** The run whose scenario other pages start with: the page's own, else the lab's, which is known before its curves are. */
function useRun(lab: Address): { readonly run?: string } {
  const { run } = useSearch({ strict: false });
  const exists = useLab((state) => state.failure?.kind !== "notFound");
  const shown = useLab((state) => state.shown?.runId ?? null);
  const id = run ?? (exists ? lab.runId : null) ?? shown;
  return id === null ? {} : { run: id };
}

const HOME = { display: "flex", alignItems: "center", gap: "0.5rem", color: "inherit", textDecoration: "none" };

/** What people may look for a page by. */
const SEARCH_WORDS: Readonly<Record<string, readonly string[]>> = {
  paper: ["reproduction", "claims", "tables"],
  sweeps: ["batch", "grid", "parameter", "study"],
  tuner: ["optimise", "optimize", "weights", "comfort"],
  robustness: ["monte", "carlo", "uncertainty", "tolerance"],
  ecu: ["hardware", "hil", "microcontroller"],
};

function Nav() {
  const lab = useSelector(useLabContext().labAddress);
  const search = useRun(lab);
  const entries = [
    { section: "lab", label: "Lab", link: labLink(lab) },
    { section: "paper", label: "Paper", link: linkOptions({ to: "/paper" }) },
    { section: "sweeps", label: "Sweeps", link: linkOptions({ to: "/sweeps" }) },
    { section: "tuner", label: "Tuner", link: linkOptions({ to: "/tuner", search }) },
    { section: "robustness", label: "Robustness", link: linkOptions({ to: "/robustness", search }) },
    { section: "ecu", label: "ECU", link: linkOptions({ to: "/ecu", search }) },
  ];
  const path = useRouterState({ select: ({ matches }) => matches[1]?.routeId.split("/")[1] });
  const section = path === "b" ? "sweeps" : path;
  // The lab has more in its header.
  const width = section === "lab" ? "lg" : "sm";
  const navigate = useNavigate();
  usePaletteEntries([
    ...entries.map(({ section, label, link }) => ({
      group: "Pages" as const,
      label,
      searchWords: SEARCH_WORDS[section],
      run: () => void navigate(link),
    })),
    { group: "Pages", label: "Manual", run: () => void window.open(MANUAL, "_blank", "noopener") },
  ]);
  return (
    <>
      <Link {...labLink(lab)} style={HOME} aria-label="Ridelab, to the lab">
        <Logo />
        <Box component="span" mr="0.6rem" fz="lg" fw={700} lts="-0.01em" visibleFrom="sm">
          Ridelab
        </Box>
      </Link>
      <Group component="nav" gap={0} wrap="nowrap" flex="none" aria-label="Pages">
        <Group component="ul" className={ui.list ?? ""} gap="0.1rem" wrap="nowrap" visibleFrom={width}>
          {entries.map(({ label, link, ...entry }) => (
            <li key={label}>
              <Link
                {...link}
                className={classes.link}
                aria-current={entry.section === section ? "page" : undefined}
                activeProps={{}}
              >
                {label}
              </Link>
            </li>
          ))}
        </Group>
        <LazyPart>
          <PagesMenu {...{ entries, section }} hiddenFrom={width} />
        </LazyPart>
      </Group>
    </>
  );
}

function Logo() {
  return (
    <svg width="26" height="26" viewBox="0 0 32 32" aria-hidden style={{ flex: "none" }}>
      <rect width="32" height="32" rx="7" fill="#0b6e6e" />
      <path
        d="M3 24h6c3 0 4-8 7-8s4 8 7 8h6"
        fill="none"
        stroke="#fff"
        strokeWidth="2.6"
        strokeLinecap="round"
        strokeLinejoin="round"
      />
      <circle cx="16" cy="9.5" r="4" fill="none" stroke="#fff" strokeWidth="2.6" />
    </svg>
  );
}

/** Keys that mean actions, and when they are somebody’s typing instead; help, and the search for an action by its name. */
const Palette = lazy(() => import("./Palette").then((module) => ({ default: module.Palette })));
const Help = lazy(() => import("./Palette").then((module) => ({ default: module.Help })));

const SEARCH = "mod+K";

export function Keyboard() {
  const [opened, setOpened] = useState<"palette" | "help" | null>(null);
  useAction("search", () => setOpened("palette"));
  useAction("help", () => setOpened("help"));
  const isTyping = useTyping();
  useWindowEvent("keydown", (event) => {
    for (const id of ACTION_IDS) {
      const keys = ACTIONS[id].keys?.find((each) => isPressed(event, each));
      if (keys === undefined || !isKeyOn(keys) || !canRun(id)) continue;
      if (opened !== null && keys !== SEARCH) return; // its code may still be on its way: what is typed is meant for it
      if (event.defaultPrevented || belongsToFocus(event.target, keys, isTyping(event.target))) return;
      event.preventDefault();
      runAction(id);
      return;
    }
  });
  const close = () => setOpened(null);
  return (
    <LazyPart onClose={close}>
      {opened === "palette" && <Palette onClose={close} />}
      {opened === "help" && <Help onClose={close} />}
    </LazyPart>
  );
}

type Pressed = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

export function isPressed(event: Pressed, keys: string): boolean {
  const parts = keys.split("+");
  const key = parts.at(-1) === "Space" ? " " : (parts.at(-1) ?? "").toLowerCase();
  // Where a sign needs Shift is the keyboard's affair.
  const isShifted = /^[a-z ]$/.test(key) ? event.shiftKey === parts.includes("shift") : true;
  return (
    event.key.toLowerCase() === key &&
    (event.ctrlKey || event.metaKey) === parts.includes("mod") &&
    !event.altKey &&
    isShifted
  );
}

const NO_TEXT = ["range", "checkbox", "radio", "button", "submit", "file"];

const takesText = (target: EventTarget | null): target is HTMLInputElement | HTMLTextAreaElement =>
  target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && !NO_TEXT.includes(target.type));

/** What Space does something to by itself. */
const takesKeys = (target: EventTarget | null) =>
  takesText(target) ||
  (target instanceof Element &&
    target.closest("select, button, a, summary, [contenteditable], input:not([type=range])") !== null);

/** Another window is open over the page; the form may be one itself. */
const isApart = (target: EventTarget | null) =>
  target instanceof Element && target.closest("[role=dialog]") !== null && target.closest("[data-scenario]") === null;

/** Follows what is typed: whether an input holds text that is not a value yet. */
function useTyping() {
  const typed = useRef<{ readonly input: EventTarget; readonly before: string } | null>(null);
  const end = () => {
    typed.current = null;
  };
  useWindowEvent(
    "beforeinput",
    ({ target, inputType }) => {
      if (inputType !== "insertLineBreak" && takesText(target) && typed.current?.input !== target)
        typed.current = { input: target, before: target.value };
    },
    true,
  );
  useWindowEvent("keydown", ({ key }) => (key === "Enter" || key === "Escape") && end(), true);
  useWindowEvent("focusout", end, true);
  return (target: EventTarget | null) =>
    takesText(target) && typed.current?.input === target && typed.current.before !== target.value;
}

/** Whether a key that stands for a command belongs to what has the focus. */
function belongsToFocus(target: EventTarget | null, keys: string, isTyping: boolean): boolean {
  if (keys === SEARCH) return false;
  if (isApart(target)) return true;
  if (keys.startsWith("mod+")) return isTyping;
  return keys === "Space" ? takesKeys(target) : takesText(target) || target instanceof HTMLSelectElement;
}
