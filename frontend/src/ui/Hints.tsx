/**
 * The page's one tooltip: it shows the `data-hint` of the element that is pointed at or reached by key.
 * A tooltip for each element would make the page slower to open.
 */

import { Tooltip } from "@mantine/core";
import { useEffect, useState } from "react";
import { createTimer } from "../lib/timer";
import ui from "./ui.module.css";

/** Pointed at for so long [ms]. */
const DELAY_MS = 300;

const hintedAt = ({ target }: Event) => (target instanceof Element ? target.closest<HTMLElement>("[data-hint]") : null);

export function Hints() {
  const [shown, setShown] = useState<HTMLElement | null>(null);
  const [text, setText] = useState<string>();
  useEffect(() => {
    let next: HTMLElement | null = null;
    const timer = createTimer(DELAY_MS, () => {
      setShown(next?.isConnected ? next : null);
      setText(next?.dataset.hint);
    });
    const turnTo = (element: HTMLElement | null) => {
      if (element === next) return;
      next = element;
      setShown(null);
      if (element) timer.start();
      else timer.stop();
    };
    const listening = new AbortController();
    const { signal } = listening;
    // A tap does what an element is for; one that has `data-hint-only` is there for its hint.
    const point = (event: PointerEvent) => {
      const hinted = hintedAt(event);
      turnTo(event.pointerType === "mouse" || hinted?.hasAttribute("data-hint-only") ? hinted : null);
    };
    const focus = (event: FocusEvent) => {
      const hinted = hintedAt(event);
      if (hinted !== next) turnTo(hinted?.matches(":focus-visible") ? hinted : null);
    };
    const blur = (event: FocusEvent) => {
      if (hintedAt(event) === next) turnTo(null);
    };
    // A finger leaves the page whenever it is lifted.
    const leave = (event: PointerEvent) => {
      if (event.pointerType === "mouse") turnTo(null);
    };
    const end = (event: KeyboardEvent) => {
      if (event.key === "Escape") turnTo(null);
    };
    document.addEventListener("pointerover", point, { signal });
    document.addEventListener("focusin", focus, { signal });
    document.addEventListener("focusout", blur, { signal });
    document.documentElement.addEventListener("pointerleave", leave, { signal });
    document.addEventListener("keydown", end, { signal, capture: true });
    return () => {
      timer.stop();
      listening.abort();
    };
  }, []);
  useEffect(() => {
    if (!shown) return undefined;
    const isSaid = shown.hasAttribute("aria-description") || shown.ariaLabel === shown.dataset.hint;
    if (!isSaid) shown.setAttribute("aria-description", shown.dataset.hint ?? "");
    const changes = new MutationObserver(() => (shown.isConnected ? setText(shown.dataset.hint) : setShown(null)));
    changes.observe(shown, { attributeFilter: ["data-hint"] });
    changes.observe(document.body, { childList: true, subtree: true });
    return () => {
      changes.disconnect();
      if (!isSaid) shown.removeAttribute("aria-description");
    };
  }, [shown]);
  return (
    shown &&
    text !== undefined && (
      <Tooltip opened target={shown} label={text} multiline maw={280} withArrow className={ui.hint ?? ""} />
    )
  );
}
