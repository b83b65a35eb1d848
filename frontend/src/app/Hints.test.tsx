// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { act, cleanup, fireEvent, render, screen } from "@testing-library/react";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { Hints } from "./headerParts";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  cleanup();
  vi.useRealTimers();
});

const page = (hinted: boolean) => (
  <MantineProvider env="test">
    {hinted && (
      <button data-hint="Why it is so" data-hint-only>
        caveat
      </button>
    )}
    <Hints />
  </MantineProvider>
);

function open() {
  const { rerender } = render(page(true));
  return { button: screen.getByRole("button"), navigate: () => rerender(page(false)) };
}

type Opened = ReturnType<typeof open>;

const pause = () => act(() => vi.advanceTimersByTimeAsync(1000));
const hint = () => screen.queryByText("Why it is so");

it("a tap shows a hint, although the tap gives its element a focus that is not visible", async () => {
  const { button } = open();
  vi.spyOn(button, "matches").mockReturnValue(false); // no :focus-visible
  fireEvent.pointerOver(button, { pointerType: "touch" });
  fireEvent.pointerLeave(document.documentElement, { pointerType: "touch" });
  fireEvent.focusIn(button);
  await pause();
  expect(hint()).not.toBeNull();
});

it.each([
  ["its element loses the focus", ({ button }: Opened) => void fireEvent.focusOut(button)],
  ["the mouse leaves the page", () => void fireEvent.pointerLeave(document.documentElement, { pointerType: "mouse" })],
  ["its element goes", ({ navigate }: Opened) => navigate()],
])("a hint goes when %s", async (_case, end) => {
  const opened = open();
  const { button } = opened;
  fireEvent.pointerOver(button, { pointerType: "mouse" });
  await pause();
  expect(hint()).not.toBeNull();
  end(opened);
  await pause();
  expect(hint()).toBeNull();
});
