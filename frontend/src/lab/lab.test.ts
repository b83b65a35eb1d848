import { describe, expect, it, onTestFinished, vi } from "vitest";
import { cursor } from "./cursor";
import { FORM } from "../scenario/form.fixture";
import { LOW, OPENING, PAPER, harness, idOf } from "./lab.fixture";

describe("the lab's address and page", () => {
  it("agree when a strategy is switched on and off while others come back", async () => {
    const { lab, labAddress, respond, agree, start, held } = harness();
    await start();
    const first = labAddress.get().runId;
    lab.setStrategies(["lqr", "passive"]);
    lab.setStrategies(["lqr", "passive", "speed_only"]); // not in the run yet: a new one, under way
    lab.setStrategies(["lqr", "passive"]);
    lab.setStrategies(OPENING); // all of it is there
    expect(held.runs.at(-1)?.signal?.aborted).toBe(true);
    expect(lab.get()).toMatchObject({ busy: false, stale: false });
    await respond();
    expect(labAddress.get().runId).toBe(first);
    expect(agree()).toEqual({ run: true, strategies: OPENING, selected: OPENING });
  });

  it("agree when strategies are switched while other roads are under way", async () => {
    const { lab, respond, agree, start } = harness();
    await start();
    lab.setRoads(5);
    lab.setStrategies(["lv", "passive"]);
    await respond();
    expect(lab.get().shown?.over?.roads).toBe(5);
    expect(agree()).toEqual({ run: true, strategies: ["lv", "passive"], selected: ["lv", "passive"] });
  });

  it("agree with the newest edit, whose predecessor's curves are no longer waited for", async () => {
    const { lab, labAddress, held, answer, respond, start } = harness();
    await start();
    lab.commit(LOW);
    await answer("runs");
    const late = held.series.at(-1);
    lab.commit({ height: 0.2 });
    expect(late?.signal?.aborted).toBe(true);
    late?.answer();
    await respond();
    expect(lab.get().shown?.scenario).toEqual({ height: 0.2 });
    expect(labAddress.get().runId).toBe(idOf({ height: 0.2 }, OPENING));
  });

  it("keep an undo while the edit is under way", async () => {
    const { lab, respond, start } = harness();
    await start();
    lab.commit(LOW);
    lab.undo();
    await respond();
    expect(lab.get()).toMatchObject({ shown: { scenario: PAPER }, history: { present: PAPER }, previousResult: null });
  });
});

it("Undo takes back a text that is no value before it takes back an edit", async () => {
  const { lab, respond, start } = harness();
  await start();
  lab.commit(LOW);
  await respond();
  lab.reject("/height", { text: "3 kg", message: "Takes cm" });
  lab.undo();
  expect(lab.get()).toMatchObject({ invalidInput: {}, busy: false, history: { present: LOW } });
  lab.undo();
  expect(lab.get()).toMatchObject({ busy: true, history: { present: PAPER } });
});

it("under a moving slider curves follow each answer, what is read twice a second or once it rests", async () => {
  const { lab, answer, held, start } = harness();
  vi.useFakeTimers();
  onTestFinished(() => void vi.useRealTimers());
  await start();
  const [shown, newest] = [() => lab.get().shown?.scenario, () => lab.newest.get()?.scenario];
  expect([shown(), newest()]).toEqual([PAPER, PAPER]);
  lab.drag(LOW);
  await answer("live");
  expect([shown(), newest()]).toEqual([LOW, LOW]);
  for (const height of [3, 4, 5, 6]) {
    await vi.advanceTimersByTimeAsync(100);
    lab.drag({ height });
    await answer("live");
    expect([shown(), newest()]).toEqual([LOW, { height }]);
  }
  const asksAfter = async (ms: number) => {
    const before = held.live.length;
    await vi.advanceTimersByTimeAsync(ms - 1);
    expect(held.live).toHaveLength(before);
    await vi.advanceTimersByTimeAsync(1);
    expect(held.live).toHaveLength(before + 1);
    await answer("live");
  };
  await asksAfter(100);
  expect(shown()).toEqual({ height: 6 });
  lab.drag({ height: 7 });
  await answer("live");
  expect([shown(), newest()]).toEqual([{ height: 6 }, { height: 7 }]);
  await asksAfter(200);
  expect(lab.get()).toMatchObject({ shown: { scenario: { height: 7 } }, busy: false });
});

it("all is asked for until an answer is read, then only the curves in sight, and one that comes into sight at once", async () => {
  const { lab, labAddress, answer, liveRequests, start } = harness();
  await start();
  lab.configure(FORM, ["brake_pressure", "speed", "pitch", "heave"]);
  const leave = lab.draw("speed");
  expect(liveRequests).toEqual([]); // no slider moves
  lab.drag(LOW);
  lab.drag({ height: 3 });
  await answer("live"); // the newer one, so that the older is aborted
  expect(lab.get().shown?.scenario).toEqual({ height: 3 });
  lab.draw("pitch");
  leave();
  lab.drag({ height: 4 });
  for (const zoom of [[3, 9], "whole", null] as const) {
    await answer("live");
    labAddress.setView({ zoom });
    cursor.set("distance", zoom === null ? 5 : null); // beside the bump: its values are read too
    lab.drag({ height: 5 });
  }
  cursor.set("distance", null);
  expect(liveRequests.map(({ signals }) => signals?.length)).toEqual([4, 4, 3, 2, 2, 2, 2]);
  expect(liveRequests[2]?.signals).toEqual(["brake_pressure", "speed", "pitch"]);
  expect(liveRequests.map(({ part = null }) => part)).toEqual([null, null, "bump", "bump", null, null, null]);
});

it("of two requests beside each other one answer is read", async () => {
  const { lab, held, start, tick } = harness();
  await start();
  for (const scenario of [LOW, { height: 3 }]) lab.drag(scenario);
  for (const { answer } of held.live) answer();
  await tick();
  expect([lab.get().shown?.scenario, lab.newest.get()?.scenario]).toEqual([LOW, { height: 3 }]);
});

it("a curve that comes into sight asks for nothing while an exact run is under way or nothing is simulated", async () => {
  const { lab, held, respond, start } = harness();
  await start();
  lab.drag(LOW);
  lab.setStrategies(["lv", "speed_only"]);
  lab.draw("pitch");
  expect(held.live).toHaveLength(1);
  await respond();
  lab.setStrategies(["recording:one"]);
  await respond();
  lab.drag(LOW);
  lab.draw("speed");
  expect(held.live).toHaveLength(1);
});

it("a live answer that comes after the slider was left is dropped", async () => {
  const { lab, answer, start } = harness();
  await start();
  lab.drag(LOW);
  expect(lab.get().busy).toBe(true);
  lab.setStrategies([]);
  lab.commit(LOW);
  expect(lab.get().busy).toBe(false);
  await answer("live");
  expect(lab.get().shown?.scenario).toEqual(PAPER);
});

describe("the state before the last edit", () => {
  it("is what was shown, from the first movement of a slider to the next edit", async () => {
    const { lab, answer, respond, start } = harness();
    await start();
    lab.drag(LOW);
    await answer("live");
    expect(lab.get()).toMatchObject({
      shown: { source: "live" },
      latestResult: { scenario: PAPER },
      previousResult: null,
    });
    lab.commit(LOW);
    await respond();
    expect(lab.get()).toMatchObject({ shown: { scenario: LOW }, previousResult: { scenario: PAPER } });
    lab.undo();
    await respond();
    expect(lab.get().previousResult?.scenario).toEqual(LOW);
  });

  it("stays when the strategies or the roads change", async () => {
    const { lab, respond, start } = harness();
    await start();
    lab.commit(LOW);
    await respond();
    lab.setStrategies(["lv"]);
    lab.setRoads(5);
    await respond();
    expect(lab.get()).toMatchObject({
      shown: { scenario: LOW, over: { roads: 5 } },
      previousResult: { scenario: PAPER },
    });
  });
});
