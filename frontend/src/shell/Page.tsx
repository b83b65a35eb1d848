/** A page beside the dashboard: its header, what it shows, and what is wrong with the connection. */

import type { ReactNode } from "react";
import { ConnectionBanner } from "./ConnectionBanner";
import { PageHeader } from "./PageHeader";
import classes from "./shell.module.css";

interface Props {
  /** The run whose scenario the page works on. */
  readonly run?: string | null;
  /** What the page itself can do, in its header. */
  readonly actions?: ReactNode;
  readonly children: ReactNode;
}

export function Page({ run = null, actions, children }: Props) {
  return (
    <div className={classes.shell}>
      <PageHeader run={run}>{actions}</PageHeader>
      {children}
      <div className={classes.notices} style={{ left: 0 }}>
        <ConnectionBanner />
      </div>
    </div>
  );
}
