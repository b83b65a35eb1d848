import { onlineManager } from "@tanstack/react-query";
import { afterEach, expect, it, vi } from "vitest";
import { ApiProblem } from "../api/problem";
import { createQueryClient } from "./queries";

afterEach(() => onlineManager.setOnline(true));

it("What is sent goes to the server while the browser says it is offline", async () => {
  onlineManager.setOnline(false);
  const client = createQueryClient();
  const sent = client.getMutationCache().build(client, { mutationFn: () => Promise.resolve("answer") });
  void sent.execute(undefined);
  await expect.poll(() => sent.state.data).toBe("answer");
  client.clear();
});

it.each([
  [429, 0, 6],
  [503, 0, 6],
  [503, null, 1],
  [422, 0, 1],
])("What the server refused with %i and a wait of %s is sent %i times", async (status, wait, times) => {
  const client = createQueryClient();
  const send = vi.fn(() => Promise.reject(new ApiProblem(status, "Refused", [], wait)));
  const sent = client.getMutationCache().build(client, { mutationFn: send });
  await expect(sent.execute(undefined)).rejects.toThrow("Refused");
  expect(send).toHaveBeenCalledTimes(times);
  client.clear();
});
