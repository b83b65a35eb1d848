/** A table that scrolls sideways by itself where it is wider than its place. */

import type { ComponentProps } from "react";
import ui from "./ui.module.css";

interface Props extends ComponentProps<"table"> {
  readonly label: string;
  /** On a surface of its own. */
  readonly card?: boolean;
}

export function ScrollTable({ label, card = false, className = "", ...table }: Props) {
  return (
    <div className={`${ui.scroll} ${card ? ui.card : ""}`} tabIndex={0} role="region" aria-label={label}>
      <table className={`${ui.table} ${className}`} {...table} />
    </div>
  );
}
