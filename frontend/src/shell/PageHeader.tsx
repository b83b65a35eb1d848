/** The header of a page beside the dashboard: name, navigation, what the page itself can do, and what every header ends with. */

import type { ReactNode } from "react";
import { HeaderEnd } from "./HeaderEnd";
import { Logo } from "./Logo";
import { Nav } from "./Nav";
import classes from "./shell.module.css";

interface Props {
  /** The run whose scenario the page works on. */
  readonly run?: string | null;
  readonly children?: ReactNode;
}

export function PageHeader({ run = null, children }: Props) {
  return (
    <header className={classes.header}>
      <a href="/" className={classes.home} aria-label="Ridelab, to the lab">
        <Logo />
      </a>
      <span className={classes.name}>Ridelab</span>
      <Nav run={run} />
      <span className={classes.grow} />
      {children}
      <HeaderEnd />
    </header>
  );
}
