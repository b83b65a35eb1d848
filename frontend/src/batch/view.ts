/** How a sweep is looked at. On its own page the address carries it; a link has its own. */

import { useState } from "react";
import type { SharedView, StrategyId } from "../api/types";
import { OPENING_FIGURE } from "./figures";

export interface BatchView {
  /** Dotted name of a swept field; `null` for the first one. */
  readonly x: string | null;
  /** Column of a figure. */
  readonly y: string;
  readonly hidden: readonly StrategyId[];
}

export function readBatchView(search: string): BatchView {
  const query = new URLSearchParams(search);
  return {
    x: query.get("x"),
    y: query.get("y") ?? OPENING_FIGURE,
    hidden: query.get("hide")?.split(",").filter(Boolean) ?? [],
  };
}

export function formatBatchView({ x, y, hidden }: BatchView): string {
  const query = new URLSearchParams();
  if (x !== null) query.set("x", x);
  if (y !== OPENING_FIGURE) query.set("y", y);
  if (hidden.length > 0) query.set("hide", hidden.join(","));
  const text = query.toString().replace(/%2C/g, ",");
  return text === "" ? "" : `?${text}`;
}

export function useBatchView(shared: SharedView | undefined) {
  const [view, setView] = useState<BatchView>(() =>
    shared ? { x: shared.x ?? null, y: shared.y ?? OPENING_FIGURE, hidden: shared.hidden ?? [] } : readBatchView(window.location.search),
  );
  const change = (part: Partial<BatchView>) => {
    const next = { ...view, ...part };
    setView(next);
    if (!shared) window.history.replaceState(null, "", window.location.pathname + formatBatchView(next));
  };
  return [view, change] as const;
}
