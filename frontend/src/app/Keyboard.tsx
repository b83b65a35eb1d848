/** Keys that mean actions, help, and the search for an action by its name. */

import { lazy, useEffect, useEffectEvent, useState } from "react";
import { ACTION_IDS, ACTIONS, canRun, runAction, useAction } from "../lab/actions";
import { LazyPart } from "../ui/LazyPart";
import { belongsToFocus, isPressed, watchTyping } from "./keys";

const Palette = lazy(() => import("./Palette").then((module) => ({ default: module.Palette })));
const Help = lazy(() => import("./Help").then((module) => ({ default: module.Help })));

export function Keyboard() {
  const [opened, setOpened] = useState<"palette" | "help" | null>(null);
  useAction("search", () => setOpened("palette"));
  useAction("help", () => setOpened("help"));
  const press = useEffectEvent((event: KeyboardEvent, isTyping: boolean) => {
    for (const id of ACTION_IDS) {
      const keys = ACTIONS[id].keys?.find((each) => isPressed(event, each));
      if (keys === undefined || !canRun(id)) continue;
      if (event.defaultPrevented || belongsToFocus(event.target, keys, isTyping)) return;
      event.preventDefault();
      runAction(id);
      return;
    }
  });
  useEffect(() => {
    const { isTyping, stop } = watchTyping();
    const onKey = (event: KeyboardEvent) => press(event, isTyping(event.target));
    document.addEventListener("keydown", onKey);
    return () => {
      stop();
      document.removeEventListener("keydown", onKey);
    };
  }, []);
  const close = () => setOpened(null);
  return (
    <LazyPart onClose={close}>
      {opened === "palette" && <Palette onClose={close} />}
      {opened === "help" && <Help onClose={close} />}
    </LazyPart>
  );
}
