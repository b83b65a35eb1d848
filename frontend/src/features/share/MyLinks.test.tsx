// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { QueryClientProvider } from "@tanstack/react-query";
import { cleanup, render, screen } from "@testing-library/react";
import userEvent from "@testing-library/user-event";
import { afterEach, expect, it, vi } from "vitest";
import { createQueryClient } from "../../server/queries";
import { MyLinks } from "./ShareLink";

afterEach(() => {
  cleanup();
  vi.unstubAllGlobals();
});

const link = (slug: string, revoked_at: string | null) => ({
  slug,
  url: `http://lab.example/s/${slug}`,
  kind: "run",
  created_at: "2026-11-28T12:03:00Z",
  revoked_at,
});

/** What was asked of a server that answers so. */
function show(answer: (method: string) => Response) {
  const asked: string[] = [];
  vi.stubGlobal("fetch", (path: string, { method = "GET" } = {}) => {
    asked.push(`${method.toUpperCase()} ${path}`);
    return Promise.resolve(answer(method.toUpperCase()));
  });
  render(
    <MantineProvider>
      <QueryClientProvider client={createQueryClient()}>
        <MyLinks />
      </QueryClientProvider>
    </MantineProvider>,
  );
  return asked;
}

it("links that open are listed, and one is taken back", async () => {
  const links = [link("A", null), link("B", "2026-11-28T13:00:00Z")];
  const asked = show((method) => {
    if (method !== "DELETE") return Response.json({ links, next: null });
    links[0] = link("A", "2026-11-28T14:00:00Z");
    return new Response(null, { status: 204 });
  });
  expect((await screen.findByRole("link")).getAttribute("href")).toBe("http://lab.example/s/A");
  await userEvent.click(screen.getByRole("button", { name: /Take back/ }));
  await vi.waitFor(() => expect(screen.queryByRole("link")).toBeNull());
  expect(asked).toContain("DELETE /api/v1/links/A");
});

it("nothing stands there where the server does not tell whose links are whose", async () => {
  const asked = show(() => Response.json({ status: 403, detail: "no", errors: [] }, { status: 403 }));
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  expect(screen.queryByRole("group", { name: "My links" })).toBeNull();
});
