/** A field of the form that somebody looks for. */

import type { Pointer } from "../scenario/path";
import { createAtom } from "@tanstack/react-store";

/** `null` once it has been shown. */
export const revealed = createAtom<Pointer | null>(null);

/** Brings it into sight, ready to be changed. */
export function focusField(pointer: Pointer): void {
  const element = document.querySelector<HTMLElement>(`[data-pointer="${pointer}"]`);
  element?.scrollIntoView({ block: "nearest" });
  const entry = element?.matches("input")
    ? element
    : element?.querySelector<HTMLElement>("input:not([type=hidden]), select");
  entry?.focus({ preventScroll: true });
}
