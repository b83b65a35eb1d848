/** Keys that mean commands, the list of them, and the search for a command by its name. */

import { lazy, useEffect, useEffectEvent, useState } from "react";
import { commands, useCommands } from "../lab/commands";
import { LazyPart } from "../ui/LazyPart";
import { belongsToFocus, isPressed, watchTyping } from "./keys";

const Palette = lazy(() => import("./Palette").then((module) => ({ default: module.Palette })));
const KeyList = lazy(() => import("./KeyList").then((module) => ({ default: module.KeyList })));

export function Keyboard() {
  const [opened, setOpened] = useState<"palette" | "keys" | null>(null);
  useCommands([
    { group: "Lab", label: "Search commands and fields", keys: "mod+K", run: () => setOpened("palette") },
    { group: "Lab", label: "List of keys", keys: "?", run: () => setOpened("keys") },
  ]);
  const press = useEffectEvent((event: KeyboardEvent, isTyping: boolean) => {
    const command = commands().find(({ keys }) => keys !== undefined && isPressed(event, keys));
    if (!command?.keys || event.defaultPrevented || belongsToFocus(event.target, command.keys, isTyping)) return;
    event.preventDefault();
    command.run();
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
      {opened === "keys" && <KeyList onClose={close} />}
    </LazyPart>
  );
}
