import { describe, expect, it } from "vitest";
import { FULL_STORAGE, memoryStorage } from "../lib/storage.fixture";
import { createPins, defaultName, MOST_PINS } from "./pins";

describe("pinned variants", () => {
  it("are there again when the tab was closed", () => {
    const storage = memoryStorage();
    const pins = createPins(storage);
    pins.add({ name: "Soft", run: "a" });
    pins.add({ name: "the same once more", run: "a" });
    pins.add({ name: "Hard", run: "b" });
    pins.rename("a", "  Softer ");
    pins.rename("b", " ");
    expect(createPins(storage).get()).toEqual([
      { name: "Softer", run: "a" },
      { name: "Hard", run: "b" },
    ]);
    pins.remove("a");
    expect(createPins(storage).get()).toEqual([{ name: "Hard", run: "b" }]);
  });

  it("of another tab stay, and are shown once they are read again", () => {
    const storage = memoryStorage();
    const [one, other] = [createPins(storage), createPins(storage)];
    one.add({ name: "Soft", run: "a" });
    other.add({ name: "Hard", run: "b" });
    one.refresh();
    expect(one.get()).toEqual([
      { name: "Soft", run: "a" },
      { name: "Hard", run: "b" },
    ]);
    one.remove("a");
    other.rename("b", "Harder");
    expect(createPins(storage).get()).toEqual([{ name: "Harder", run: "b" }]);
  });

  it("stay until the tab is closed where the storage is full", () => {
    const pins = createPins(FULL_STORAGE);
    pins.add({ name: "Soft", run: "a" });
    pins.add({ name: "Hard", run: "b" });
    expect(pins.get()).toHaveLength(2);
  });

  it("are at most eight", () => {
    const pins = createPins(memoryStorage());
    for (let run = 0; run < 12; run++) pins.add({ name: `n${run}`, run: String(run) });
    expect(pins.get()).toHaveLength(MOST_PINS);
  });

  it("ignore what cannot be read, and need no storage", () => {
    const read = (text: string) => createPins(memoryStorage({ "ridelab-pins": text })).get();
    expect(read("{")).toEqual([]);
    expect(read('[{"name": "x"}, {"name": "y", "run": "b"}]')).toEqual([{ name: "y", run: "b" }]);
    expect(createPins(null).get()).toEqual([]);
  });

  it("are called by what differs from the paper, else by a number", () => {
    const pins = [
      { name: "Bump height 0.1 → 0.2 m", run: "a" },
      { name: "Variant 1", run: "b" },
    ];
    expect(defaultName("Target speed 22.5 → 15 km/h", pins)).toBe("Target speed 22.5 → 15 km/h");
    expect(defaultName("Bump height 0.1 → 0.2 m", pins)).toBe("Variant 2");
    expect(defaultName("", [])).toBe("Variant 1");
  });
});
