// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { act, cleanup, fireEvent, render } from "@testing-library/react";
import { afterEach, describe, expect, it, vi } from "vitest";
import { useAction } from "../lab/actions";
import { isPressed, Keyboard } from "./Shell";

vi.mock("./Palette", () => new Promise(() => undefined)); // its code never comes

afterEach(cleanup);

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

it("what is typed while the search is on its way is no command", () => {
  const pin = vi.fn();
  function Page() {
    useAction("pin", pin);
    return <Keyboard />;
  }
  render(
    <MantineProvider env="test">
      <Page />
    </MantineProvider>,
  );
  fireEvent.keyDown(document.body, { key: "p" });
  expect(pin).toHaveBeenCalledTimes(1);
  act(() => void fireEvent.keyDown(document.body, { key: "k", ctrlKey: true }));
  fireEvent.keyDown(document.body, { key: "p" });
  expect(pin).toHaveBeenCalledTimes(1);
});
