import { describe, expect, it } from "vitest";
import { FULL_STORAGE, memoryStorage } from "../lib/storage.fixture";
import { createLibrary } from "./library";

let seconds = 0;
const clock = () => new Date(1000 * ++seconds).toISOString();
const open = (storage: Storage | null) => createLibrary(storage, clock);
const names = (library: ReturnType<typeof open>) => library.get().map(({ kind, name }) => `${kind} ${name}`);
const [SOFT, HARD] = [{ mpc: { weight: 1 } }, { mpc: { weight: 9 } }];

describe("one's own library", () => {
  it("keeps each kind by name, the newest first, and replaces what has the name", () => {
    const storage = memoryStorage();
    const library = open(storage);
    library.save("scenario", " Soft: 2 ", SOFT);
    library.save("vehicle", "Van", { body_mass: 900 });
    library.save("scenario", "Soft: 2", HARD);
    expect(open(storage).get()).toMatchObject([
      { kind: "scenario", name: "Soft: 2", value: HARD },
      { kind: "vehicle", name: "Van" },
    ]);
  });

  it("opens what core 0.3.0 stored with the filter it had, and what it stores itself as it is", () => {
    const storage = memoryStorage();
    const kalman = { estimation: { kind: "kalman" } };
    storage.setItem(
      "ridelab-library:scenario:Old",
      JSON.stringify({ value: kalman, saved: new Date(0).toISOString() }),
    );
    open(storage).save("scenario", "New", kalman);
    const had = { estimation: { kind: "kalman", knows_preview: false } };
    expect(
      Object.fromEntries(
        open(storage)
          .get()
          .map(({ name, value }) => [name, value]),
      ),
    ).toEqual({ Old: had, New: kalman });
    const library = open(storage);
    const [, old] = library.get();
    if (!old) throw new Error("not read");
    library.rename(old, "Older");
    expect(open(storage).get()[1]).toMatchObject({ name: "Older", value: had });
  });

  it("renames, deletes and takes a deletion back; a name that is taken is refused", () => {
    const library = open(memoryStorage());
    library.save("scenario", "A", SOFT);
    library.save("scenario", "B", HARD);
    const [b] = library.get();
    if (!b) throw new Error("nothing saved");
    expect(() => library.rename(b, "A")).toThrow("There is a scenario of this name");
    library.rename(b, "C");
    expect(names(library)).toEqual(["scenario C", "scenario A"]);
    library.remove({ ...b, name: "C" });
    expect(names(library)).toEqual(["scenario A"]);
    library.restore({ ...b, name: "C" });
    expect(library.get()[0]).toMatchObject({ name: "C", value: HARD, saved: b.saved });
  });

  it("takes a deletion back without replacing what has the name by then", () => {
    const library = open(memoryStorage());
    library.save("scenario", "A", SOFT);
    const [a] = library.get();
    if (!a) throw new Error("nothing saved");
    library.remove(a);
    library.save("scenario", "A", HARD);
    library.restore(a);
    expect(library.get()).toMatchObject([
      { name: "A", value: HARD },
      { name: "A (2)", value: SOFT },
    ]);
  });

  it("adds a file's content once, and never over another's", () => {
    const library = open(memoryStorage());
    expect(library.add("scenario", "hump", SOFT)).toBe("hump");
    expect(library.add("scenario", "hump", HARD)).toBe("hump (2)");
    expect(library.add("scenario", "again", { mpc: { weight: 1 } })).toBe("hump");
    expect(library.get()).toHaveLength(2);
  });

  it("loses nothing that another tab has saved", () => {
    const storage = memoryStorage();
    const [one, other] = [open(storage), open(storage)];
    one.save("scenario", "A", SOFT);
    other.save("scenario", "B", HARD);
    one.refresh();
    expect(names(one)).toEqual(["scenario B", "scenario A"]);
    expect(names(open(storage))).toEqual(["scenario B", "scenario A"]);
  });

  it("says so where the browser keeps nothing, and ignores what it cannot read", () => {
    for (const storage of [null, FULL_STORAGE])
      expect(() => open(storage).save("scenario", "A", SOFT)).toThrow("export it as a file");
    const storage = memoryStorage();
    for (const [key, text] of [
      ["scenario:A", "{"],
      ["scenario:B", '{"value": 3, "saved": ""}'],
      ["colour:C", '{"value": {}, "saved": ""}'],
    ])
      storage.setItem(`ridelab-library:${key ?? ""}`, text ?? "");
    expect(open(storage).get()).toEqual([]);
  });
});
