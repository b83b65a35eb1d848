import { describe, expect, it } from "vitest";
import { isPressed } from "./Keyboard";

const press = (key: string, ...held: readonly ("ctrlKey" | "metaKey" | "shiftKey" | "altKey")[]) => ({
  key,
  ctrlKey: held.includes("ctrlKey"),
  metaKey: held.includes("metaKey"),
  shiftKey: held.includes("shiftKey"),
  altKey: held.includes("altKey"),
});

describe("a key", () => {
  it.each([
    ["mod+Z", press("z", "ctrlKey")],
    ["mod+Z", press("z", "metaKey")],
    ["mod+shift+Z", press("Z", "ctrlKey", "shiftKey")],
    ["Space", press(" ")],
    ["?", press("?", "shiftKey")],
    ["?", press("?")],
  ])("is %s", (keys, event) => expect(isPressed(event, keys)).toBe(true));

  it.each([
    ["mod+Z", press("Z", "ctrlKey", "shiftKey")],
    ["mod+Z", press("z")],
    ["mod+Z", press("z", "ctrlKey", "altKey")],
    ["Space", press(" ", "shiftKey")],
  ])("is not %s", (keys, event) => expect(isPressed(event, keys)).toBe(false));
});
