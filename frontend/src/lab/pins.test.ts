import { describe, expect, it } from "vitest";
import { createPins, defaultName, MOST_PINS } from "./pins";

function fakeStorage(content: string | null = null): Storage {
  let text = content;
  return { getItem: () => text, setItem: (_: string, value: string) => (text = value) } as unknown as Storage;
}

describe("pinned variants", () => {
  it("are there again when the tab was closed", () => {
    const storage = fakeStorage();
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
    const storage = fakeStorage();
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
    const full = {
      getItem: () => null,
      setItem: () => {
        throw new DOMException("full", "QuotaExceededError");
      },
    } as unknown as Storage;
    const pins = createPins(full);
    pins.add({ name: "Soft", run: "a" });
    pins.add({ name: "Hard", run: "b" });
    expect(pins.get()).toHaveLength(2);
  });

  it("are at most eight", () => {
    const pins = createPins(fakeStorage());
    for (let run = 0; run < 12; run++) pins.add({ name: `n${run}`, run: String(run) });
    expect(pins.get()).toHaveLength(MOST_PINS);
  });

  it("ignore what cannot be read, and need no storage", () => {
    expect(createPins(fakeStorage("{")).get()).toEqual([]);
    expect(createPins(fakeStorage('[{"name": "x"}, {"name": "y", "run": "b"}]')).get()).toEqual([
      { name: "y", run: "b" },
    ]);
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
