/** What stays from page to page: name, navigation, the colour scheme, and what is wrong with the connection. */

import { Link, Outlet } from "@tanstack/react-router";
import { useMemo, useState, lazy, type ReactNode } from "react";
import { Box, Button } from "@mantine/core";
import { useLabContext } from "../lab/context";
import { ConnectionBanner } from "./ConnectionBanner";
import { Keyboard } from "./Keyboard";
import { Nav } from "./Nav";
import { SlotsContext } from "../ui/Page";
import classes from "../ui/shell.module.css";
import { Blank, Loading } from "../ui/Blank";
import ui from "../ui/ui.module.css";
import { tokenWanted } from "../api/connection";
import { useSelector } from "@tanstack/react-store";
import { LazyPart } from "../ui/LazyPart";
import { firstCurves } from "../lib/firstCurves";

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

/** Until its route has what the page needs. */
export function PageLoading() {
  return (
    <main className={ui.main}>
      <Loading label="Loading the page" heights={[28, 96, 440]} />
    </main>
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
