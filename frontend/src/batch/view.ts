/** How a sweep is looked at. On its own page the address carries it; a link has its own. */

import { useNavigate, useSearch } from "@tanstack/react-router";
import { useState } from "react";
import type { SharedView, StrategyId } from "../api/types";
import { listOf } from "../state/address";
import { OPENING_FIGURE } from "./figures";

export interface BatchView {
  /** Dotted name of a swept field; `null` for the first one. */
  readonly x: string | null;
  /** Column of a figure. */
  readonly y: string;
  readonly hidden: readonly StrategyId[];
}

export type BatchSearch = Partial<Record<"x" | "y" | "hide", string>>;
type Change = (part: Partial<BatchView>) => void;

export const viewOf = ({ x, y, hide }: BatchSearch): BatchView => ({ x: x ?? null, y: y ?? OPENING_FIGURE, hidden: listOf(hide) });

export const searchOf = ({ x, y, hidden }: BatchView): BatchSearch => ({
  ...(x !== null && { x }),
  ...(y !== OPENING_FIGURE && { y }),
  ...(hidden.length > 0 && { hide: hidden.join(",") }),
});

export function useBatchView(): readonly [BatchView, Change] {
  const view = viewOf(useSearch({ from: "/b/$id" }));
  const navigate = useNavigate();
  return [view, (part) => void navigate({ to: ".", search: searchOf({ ...view, ...part }), replace: true, resetScroll: false })];
}

export function useSharedView({ x, y, hidden }: SharedView): readonly [BatchView, Change] {
  const [view, setView] = useState<BatchView>({ x: x ?? null, y: y ?? OPENING_FIGURE, hidden: hidden ?? [] });
  return [view, (part) => setView((before) => ({ ...before, ...part }))];
}
