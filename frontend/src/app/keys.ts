/** Which key means which command, and when it is somebody's typing instead. */

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
export function watchTyping() {
  let typed: { readonly input: EventTarget; readonly before: string } | null = null;
  const begin = ({ target, inputType }: InputEvent) => {
    if (inputType !== "insertLineBreak" && takesText(target) && typed?.input !== target)
      typed = { input: target, before: target.value };
  };
  const end = () => {
    typed = null;
  };
  const onKey = ({ key }: KeyboardEvent) => {
    if (key === "Enter" || key === "Escape") end();
  };
  document.addEventListener("beforeinput", begin, true);
  document.addEventListener("keydown", onKey, true);
  document.addEventListener("focusout", end, true);
  return {
    isTyping: (target: EventTarget | null) =>
      takesText(target) && typed?.input === target && typed.before !== target.value,
    stop: () => {
      document.removeEventListener("beforeinput", begin, true);
      document.removeEventListener("keydown", onKey, true);
      document.removeEventListener("focusout", end, true);
    },
  };
}

/** Whether a key that stands for a command belongs to what has the focus. */
export function belongsToFocus(target: EventTarget | null, keys: string, isTyping: boolean): boolean {
  if (keys === "mod+K") return false;
  if (isApart(target)) return true;
  if (keys.startsWith("mod+")) return isTyping;
  return keys === "Space" ? takesKeys(target) : takesText(target) || target instanceof HTMLSelectElement;
}

/** Keys as they are written on this machine's keyboard. */
export const keyNames = (keys: string): string => {
  const mod = /Mac|iPhone|iPad/.test(navigator.userAgent) ? "⌘" : "Ctrl";
  return keys.replace("mod", mod).replace("shift", "Shift").replace(/\+/g, " + ");
};
