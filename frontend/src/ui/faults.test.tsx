// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { cleanup, render, screen } from "@testing-library/react";
import userEvent from "@testing-library/user-event";
import { lazy, type ReactNode } from "react";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { endFirstView } from "../lib/firstCurves";
import { Card } from "./Card";
import { LazyPart } from "./LazyPart";

beforeEach(() => {
  vi.spyOn(console, "error").mockReturnValue(undefined); // React writes there what a boundary has caught
  endFirstView();
});
afterEach(() => {
  cleanup();
  vi.restoreAllMocks();
});

const shown = (children: ReactNode) => render(<MantineProvider>{children}</MantineProvider>);

it("a fault in one card leaves the others, and can be tried again", async () => {
  let broken = true;
  const Part = () => {
    if (broken) throw new Error("no such signal");
    return <p>curves</p>;
  };
  shown(
    <>
      <Card aria-label="One">
        <Part />
      </Card>
      <Card aria-label="Other">numbers</Card>
    </>,
  );
  expect(screen.getByRole("region", { name: "One" }).textContent).toContain("could not be shown: no such signal");
  expect(screen.getByRole("region", { name: "Other" }).textContent).toBe("numbers");
  broken = false;
  await userEvent.click(screen.getByRole("button", { name: "Try again" }));
  expect(screen.getByText("curves")).toBeTruthy();
});

it("a dialog whose code is missing says so, closes, and leaves what was there", async () => {
  const Missing = lazy(() => Promise.reject<{ default: () => null }>(new Error("404")));
  const close = vi.fn();
  shown(
    <LazyPart fallback={<p>the lab</p>} onClose={close}>
      <Missing />
    </LazyPart>,
  );
  await screen.findByRole("dialog", { name: "This part of the page could not be shown" });
  expect(screen.getByText("the lab")).toBeTruthy();
  const [closeButton] = screen.getAllByRole("button", { name: "Close" });
  if (closeButton) await userEvent.click(closeButton);
  expect(close).toHaveBeenCalledOnce();
});
