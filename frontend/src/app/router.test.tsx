// @vitest-environment happy-dom
import { createMemoryHistory } from "@tanstack/react-router";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { createQueryClient } from "../server/queries";
import { createAppRouter } from "./router";

const answer = vi.fn<(path: string) => Response | Promise<Response>>();
beforeEach(() => {
  vi.stubGlobal("fetch", (path: string) => Promise.resolve(answer(path)));
});
afterEach(() => {
  vi.unstubAllGlobals();
  answer.mockReset();
});

/** The page's routes, with the server's lists in the cache. */
function routes() {
  const queries = createQueryClient();
  for (const name of ["strategies", "figures", "schema"]) queries.setQueryData([name], []);
  for (const path of ["/catalogue", "/presets"]) queries.setQueryData([path, {}], []);
  const history = createMemoryHistory({ initialEntries: ["/sweeps"] });
  const router = createAppRouter(queries);
  router.update({ ...router.options, history });
  return { queries, router };
}

const BATCH = { id: "B", state: "done" };

it("a sweep's address waits for a busy server, and asks again on a later visit", async () => {
  const { queries, router } = routes();
  const status = () => router.state.matches.at(-1)?.status;
  answer
    .mockReturnValueOnce(new Response("{}", { status: 503 }))
    .mockReturnValueOnce(Response.json(BATCH))
    .mockReturnValueOnce(Response.json({ grid: {} }));
  await router.navigate({ to: "/b/$id", params: { id: "B" } });
  expect(status()).toBe("success");
  const address = "/api/v1/batches/B";
  expect(answer.mock.calls.flat()).toEqual([address, address, `${address}/sweep`]);

  await router.navigate({ to: "/sweeps" });
  queries.removeQueries({ queryKey: ["batch"] }); // as it is five minutes after nobody shows it
  answer.mockReturnValueOnce(new Response("{}", { status: 404 }));
  await router.navigate({ to: "/b/$id", params: { id: "B" } });
  expect(status()).toBe("notFound");
});

it("a study's address asks for the study and for what may be varied at once", async () => {
  const { router } = routes();
  answer.mockReturnValue(new Promise<Response>(() => undefined)); // the server takes its time
  void router.navigate({ to: "/robustness/$id", params: { id: "B" } });
  await vi.waitFor(
    () => expect(answer.mock.calls.flat().sort()).toEqual(["/api/v1/batches/B", "/api/v1/robustness"]),
    60_000,
  );
});
