/** The header of a page beside the dashboard: name, navigation, what the page itself can do, and the colour scheme. */

import type { ReactNode } from "react";
import { Logo } from "./Logo";
import { Nav } from "./Nav";
import { SchemeToggle } from "./SchemeToggle";
import classes from "./shell.module.css";

export function PageHeader({ children }: { readonly children?: ReactNode }) {
  return (
    <header className={classes.header}>
      <a href="/" className={classes.home} aria-label="Ridelab, to the lab">
        <Logo />
      </a>
      <span className={classes.name}>Ridelab</span>
      <Nav />
      <span className={classes.grow} />
      {children}
      <SchemeToggle />
    </header>
  );
}
