import { describe, expect, it } from "vitest";
import { DEFAULT_VIEW } from "./address";
import { LOW, PAPER, harness, idOf } from "./lab.fixture";

describe("the baseline", () => {
  it("runs with every edit and every step of a slider where it is hidden", async () => {
    const { lab, labAddress, liveRequests, respond, agree, start } = harness();
    await start();
    lab.setStrategies(["lv", "lqr"]);
    lab.commit(LOW);
    await respond();
    expect(labAddress.get().runId).toBe(idOf(LOW, ["lv", "lqr", "passive"]));
    expect(agree()).toEqual({ run: true, strategies: ["lv", "lqr"], selected: ["lv", "lqr"] });
    lab.drag({ height: 0.2 });
    expect(liveRequests.at(-1)).toMatchObject({ strategies: ["lv", "lqr", "passive"], baseline: "passive" });
  });

  it("stays a recorded drive that is hidden when another strategy is added", async () => {
    const { lab, labAddress, respond, liveRequests, start } = harness();
    await start();
    lab.setStrategies(["lv", "recording:one"]);
    await respond();
    labAddress.setView({ baseline: "recording:one" });
    lab.setStrategies(["lv"]);
    lab.setStrategies(["lv", "own"]);
    await respond();
    expect(labAddress.get().runId).toBe(idOf(PAPER, ["lv", "own", "recording:one"]));
    lab.drag(LOW); // nothing simulates it
    expect(liveRequests.at(-1)?.strategies).toEqual(["lv", "own"]);
    expect(liveRequests.at(-1)?.baseline).toBeUndefined();
  });

  it("is the service's where an opened run does not have the one that was chosen", async () => {
    const { lab, labAddress, respond, start } = harness();
    await start();
    labAddress.setView({ baseline: "skyhook" });
    lab.open({ runId: "low", slug: null, view: DEFAULT_VIEW });
    await respond();
    expect(labAddress.get().view.baseline).toBe("passive");
  });
});
