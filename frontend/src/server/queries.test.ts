import { onlineManager } from "@tanstack/react-query";
import { afterEach, expect, it } from "vitest";
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
