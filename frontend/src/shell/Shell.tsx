/** What stays from page to page: name, navigation, the colour scheme, and what is wrong with the connection. */

import { Outlet } from "@tanstack/react-router";
import { useMemo, useState } from "react";
import { useLabContext } from "../state/context";
import { ConnectionBanner } from "./ConnectionBanner";
import { HeaderEnd } from "./HeaderEnd";
import { Keyboard } from "./Keyboard";
import { LoginGate } from "./LoginGate";
import { Nav } from "./Nav";
import { SlotsContext } from "./slots";
import classes from "./shell.module.css";

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
