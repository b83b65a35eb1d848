/** What stays from page to page: name, navigation, the colour scheme, and what is wrong with the connection. */

import { Link, Outlet } from "@tanstack/react-router";
import { useMemo, useState, lazy, type ReactNode } from "react";
import { Box, Button, useComputedColorScheme, useMantineColorScheme } from "@mantine/core";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useLabContext } from "../lab/context";
import { ConnectionBanner } from "./ConnectionBanner";
import { Keyboard } from "./Keyboard";
import { Nav } from "./Nav";
import { SlotsContext } from "../ui/Page";
import classes from "../ui/shell.module.css";
import { Blank } from "../ui/Blank";
import { tokenWanted } from "../api/connection";
import { useStore } from "../lib/store";
import { LazyPart } from "../ui/LazyPart";
import { ask, query } from "../api/http";
import { IconLogout, IconMoon, IconSun } from "../ui/icons";
import { IconButton } from "../ui/IconButton";

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
          <button type="button" className={classes.skip} onClick={focusMain}>
            Skip to the page’s content
          </button>
          <header className={classes.header}>
            <Nav />
            <div className={classes.tools} ref={setTools} />
            <HeaderEnd />
          </header>
          <Outlet />
          <Keyboard />
          <div className={classes.notices}>
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
        <Button renderRoot={(props) => <Link to="/" {...props} />}>Go to the lab</Button>
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
        <Button onClick={() => window.location.reload()}>Load again</Button>
      </Blank>
    </Box>
  );
}

const Login = lazy(async () => ({ default: (await import("./Login")).Login }));

/** The page, or what asks for a token where the service wants one. */
function LoginGate({ children }: { readonly children: ReactNode }) {
  if (!useStore(tokenWanted)) {
    return children;
  }
  return (
    <LazyPart>
      <Login />
    </LazyPart>
  );
}

/** What every header ends with: dark or light, whatever the system says, and logging out where there is a login. */
function HeaderEnd() {
  const { setColorScheme } = useMantineColorScheme();
  const isDark = useComputedColorScheme("light") === "dark";
  const next = isDark ? "light" : "dark";
  const name = useQuery({ ...query("/login", {}), staleTime: Infinity }).data?.name ?? null;
  const logOut = useMutation({
    mutationFn: () => ask("delete", "/login", {}),
    onSuccess: () => window.location.reload(),
  });
  return (
    <>
      <IconButton label={`Use ${next} colours`} onClick={() => setColorScheme(next)}>
        {isDark ? <IconSun size={18} stroke={1.7} /> : <IconMoon size={18} stroke={1.7} />}
      </IconButton>
      {name !== null && (
        <IconButton
          label={logOut.error?.message ?? `Log out ${name}`}
          disabled={logOut.isPending}
          onClick={() => logOut.mutate()}
        >
          <IconLogout size={18} stroke={1.7} />
        </IconButton>
      )}
    </>
  );
}
