/** Keys that mean actions, and when they are somebody’s typing instead; help, and the search for an action by its name. */

import { useWindowEvent } from "@mantine/hooks";
import { lazy, useRef, useState } from "react";
import { ACTION_IDS, ACTIONS, canRun, isKeyOn, runAction, useAction } from "../lab/actions";
import { LazyPart } from "../ui/LazyPart";

const Palette = lazy(() => import("./Palette").then((module) => ({ default: module.Palette })));
const Help = lazy(() => import("./Palette").then((module) => ({ default: module.Help })));

const SEARCH = "mod+K";

export function Keyboard() {
  const [opened, setOpened] = useState<"palette" | "help" | null>(null);
  useAction("search", () => setOpened("palette"));
  useAction("help", () => setOpened("help"));
  const isTyping = useTyping();
  useWindowEvent("keydown", (event) => {
    for (const id of ACTION_IDS) {
      const keys = ACTIONS[id].keys?.find((each) => isPressed(event, each));
      if (keys === undefined || !isKeyOn(keys) || !canRun(id)) continue;
      if (opened !== null && keys !== SEARCH) return; // its code may still be on its way: what is typed is meant for it
      if (event.defaultPrevented || belongsToFocus(event.target, keys, isTyping(event.target))) return;
      event.preventDefault();
      runAction(id);
      return;
    }
  });
  const close = () => setOpened(null);
  return (
    <LazyPart onClose={close}>
      {opened === "palette" && <Palette onClose={close} />}
      {opened === "help" && <Help onClose={close} />}
    </LazyPart>
  );
}

type Pressed = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

export function isPressed(event: Pressed, keys: string): boolean {
  const parts = keys.split("+");
  const key = parts.at(-1) === "Space" ? " " : (parts.at(-1) ?? "").toLowerCase();
  // Where a sign needs Shift is the keyboard's affair.
  const isShifted = /^[a-z ]$/.test(key) ? event.shiftKey === parts.includes("shift") : true;
  return (
    event.key.toLowerCase() === key &&
    (event.ctrlKey || event.metaKey) === parts.includes("mod") &&
    !event.altKey &&
    isShifted
  );
}

const NO_TEXT = ["range", "checkbox", "radio", "button", "submit", "file"];

const takesText = (target: EventTarget | null): target is HTMLInputElement | HTMLTextAreaElement =>
  target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && !NO_TEXT.includes(target.type));

/** What Space does something to by itself. */
const takesKeys = (target: EventTarget | null) =>
  takesText(target) ||
  (target instanceof Element &&
    target.closest("select, button, a, summary, [contenteditable], input:not([type=range])") !== null);

/** Another window is open over the page; the form may be one itself. */
const isApart = (target: EventTarget | null) =>
  target instanceof Element && target.closest("[role=dialog]") !== null && target.closest("[data-scenario]") === null;

/** Follows what is typed: whether an input holds text that is not a value yet. */
function useTyping() {
  const typed = useRef<{ readonly input: EventTarget; readonly before: string } | null>(null);
  const end = () => {
    typed.current = null;
  };
  useWindowEvent(
    "beforeinput",
    ({ target, inputType }) => {
      if (inputType !== "insertLineBreak" && takesText(target) && typed.current?.input !== target)
        typed.current = { input: target, before: target.value };
    },
    true,
  );
  useWindowEvent("keydown", ({ key }) => (key === "Enter" || key === "Escape") && end(), true);
  useWindowEvent("focusout", end, true);
  return (target: EventTarget | null) =>
    takesText(target) && typed.current?.input === target && typed.current.before !== target.value;
}

/** Whether a key that stands for a command belongs to what has the focus. */
function belongsToFocus(target: EventTarget | null, keys: string, isTyping: boolean): boolean {
  if (keys === SEARCH) return false;
  if (isApart(target)) return true;
  if (keys.startsWith("mod+")) return isTyping;
  return keys === "Space" ? takesKeys(target) : takesText(target) || target instanceof HTMLSelectElement;
}
