/** What a page puts into the shell around it: its tools in the header, its notices over the page's foot. */

import { createContext, use, type ReactNode } from "react";
import { createPortal } from "react-dom";

export type Slot = "tools" | "notices";

export const SlotsContext = createContext<Readonly<Record<Slot, HTMLElement | null>>>({ tools: null, notices: null });

export function ShellSlot({ name, children }: { readonly name: Slot; readonly children: ReactNode }) {
  const element = use(SlotsContext)[name];
  return element && createPortal(children, element);
}
