/** Says of what is pointed at, or reached by key, what its `data-hint` says: one for the page, as each tooltip of its own makes an opening longer. */

import { Tooltip } from "@mantine/core";
import { useEffect, useState } from "react";
import { createTimer } from "../lib/timer";
import ui from "./ui.module.css";

/** Pointed at for so long [ms]. */
const DELAY_MS = 300;

/** A tap does what an element is for; one that has `data-hint-only` is there for its hint. */
const isHinting = (element: Element, event: Event) =>
  event instanceof PointerEvent
    ? event.pointerType === "mouse" || element.hasAttribute("data-hint-only")
    : element.matches(":focus-visible");

export function Hints() {
  const [shown, setShown] = useState<HTMLElement | null>(null);
  const [text, setText] = useState<string>();
  useEffect(() => {
    let next: HTMLElement | null = null;
    const timer = createTimer(DELAY_MS, () => {
      setShown(next);
      setText(next?.dataset.hint);
    });
    const turnTo = (element: HTMLElement | null) => {
      if (element === next) return;
      next = element;
      setShown(null);
      if (element) timer.start();
      else timer.stop();
    };
    const point = (event: Event) => {
      const hinted = event.target instanceof Element ? event.target.closest<HTMLElement>("[data-hint]") : null;
      turnTo(hinted && isHinting(hinted, event) ? hinted : null);
    };
    const end = (event: KeyboardEvent) => {
      if (event.key === "Escape") turnTo(null);
    };
    document.addEventListener("pointerover", point);
    document.addEventListener("focusin", point);
    document.addEventListener("keydown", end, { capture: true });
    return () => {
      timer.stop();
      document.removeEventListener("pointerover", point);
      document.removeEventListener("focusin", point);
      document.removeEventListener("keydown", end, { capture: true });
    };
  }, []);
  useEffect(() => {
    if (!shown) return undefined;
    const isSaid = shown.hasAttribute("aria-description") || shown.ariaLabel === shown.dataset.hint;
    if (!isSaid) shown.setAttribute("aria-description", shown.dataset.hint ?? "");
    const changes = new MutationObserver(() => setText(shown.dataset.hint));
    changes.observe(shown, { attributeFilter: ["data-hint"] });
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
