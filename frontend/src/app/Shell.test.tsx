// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { QueryClient, QueryClientProvider } from "@tanstack/react-query";
import {
  createMemoryHistory,
  createRootRoute,
  createRoute,
  createRouter,
  notFound,
  RouterProvider,
} from "@tanstack/react-router";
import { cleanup, render, screen } from "@testing-library/react";
import userEvent from "@testing-library/user-event";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { ApiProblem } from "../api/problem";
import { PageLoading } from "../ui/Page";
import { PageFailed, PageNotFound } from "./Shell";

const loader = vi.fn<() => Promise<void>>();
beforeEach(() => {
  // React and the router write there what a boundary has caught.
  for (const level of ["error", "warn"] as const) vi.spyOn(console, level).mockReturnValue(undefined);
  document.title = "The page before · Ridelab";
});
afterEach(() => {
  cleanup();
  vi.restoreAllMocks();
});

/** A page whose route has this loader. */
function show(component = () => <p>the page</p>) {
  const root = createRootRoute();
  const page = createRoute({
    getParentRoute: () => root,
    path: "/",
    loader,
    component,
    pendingComponent: PageLoading,
    pendingMs: 0,
    errorComponent: PageFailed,
    notFoundComponent: PageNotFound,
  });
  const router = createRouter({ routeTree: root.addChildren([page]), history: createMemoryHistory() });
  render(
    <MantineProvider>
      <QueryClientProvider client={new QueryClient()}>
        <RouterProvider router={router as never} />
      </QueryClientProvider>
    </MantineProvider>,
  );
}

it("what the server refused is said, and asked for again without loading the page again", async () => {
  loader.mockRejectedValueOnce(new ApiProblem(500, "The stored job cannot be read", []));
  show();
  const failed = await screen.findByRole("alert");
  expect(failed.textContent).toBe("This page could not be shownThe stored job cannot be readTry again");
  expect(document.title).toBe("This page could not be shown · Ridelab");
  await userEvent.click(screen.getByRole("button", { name: "Try again" }));
  await screen.findByText("the page");
});

it("a fault in drawing leaves a way to load the page again", async () => {
  show(() => {
    throw new Error("no such signal");
  });
  expect((await screen.findByRole("alert")).textContent).toContain("no such signal. What was computed is stored");
  expect(screen.getByRole("button", { name: "Load again" })).toBeTruthy();
});

it("the tab is not named after the page before, while the next is fetched or where there is none", async () => {
  let endLoading: () => void = () => undefined;
  const loaded = new Promise<void>((resolve) => (endLoading = resolve));
  loader.mockImplementationOnce(() => loaded.then(() => void notFound({ throw: true })));
  show();
  await screen.findByLabelText("Loading the page");
  expect(document.title).toBe("Ridelab");
  endLoading();
  await screen.findByText("There is no page at this address");
  expect(document.title).toBe("There is no page at this address · Ridelab");
});
