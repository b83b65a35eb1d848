/** What a page puts into the shell around it: its tools in the header, its notices over the page's foot. */

import { createContext, use, type ReactNode } from "react";
import { createPortal } from "react-dom";

export type Place = "tools" | "notices";

export const PlacesContext = createContext<Readonly<Record<Place, HTMLElement | null>>>({ tools: null, notices: null });

export function InShell({ place, children }: { readonly place: Place; readonly children: ReactNode }) {
  const element = use(PlacesContext)[place];
  return element && createPortal(children, element);
}
