/** The last resort: a fault in drawing leaves a link to load again instead of an empty page. */

import { Component, type ReactNode } from "react";
import classes from "./shell.module.css";

interface Props {
  readonly children: ReactNode;
}

interface State {
  readonly failed: boolean;
}

export class ErrorBoundary extends Component<Props, State> {
  override state: State = { failed: false };

  static getDerivedStateFromError(): State {
    return { failed: true };
  }

  override render(): ReactNode {
    if (!this.state.failed) return this.props.children;
    return (
      <div className={classes.blank} role="alert">
        <strong>This page has failed</strong>
        <span>The run is stored at this address; loading it again shows it.</span>
        <a href={window.location.href}>Load again</a>
      </div>
    );
  }
}
