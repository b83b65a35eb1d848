import { describe, expect, it } from "vitest";
import { DEFAULT_VIEW, parseSearch, readLabSearch, searchOf, stringifySearch, viewOf, type View } from "./address";
import { pinReference } from "./compare";
import { begin, record, redo, undo } from "./history";

describe("undo and redo", () => {
  it("walk the same way back and forth", () => {
    const history = record(record(begin("a"), "b"), "c");
    expect(undo(history).present).toBe("b");
    expect(redo(undo(history))).toEqual(history);
    expect(undo(undo(undo(history))).present).toBe("a");
  });

  it("forget the future once something new is done", () => {
    expect(redo(record(undo(record(begin("a"), "b")), "c")).present).toBe("c");
  });
});

describe("the address", () => {
  const there = (view: View) => stringifySearch(searchOf(view));
  const back = (search: string) => viewOf(readLabSearch(parseSearch(search)));

  it("is short for the usual view", () => {
    expect(there(DEFAULT_VIEW)).toBe("");
  });

  it("carries the view there and back", () => {
    const view = {
      axis: "time",
      baseline: "lqr",
      hidden: ["passive", "lv"],
      zoom: [98.5, 112],
      reference: "before",
      differences: true,
      instant: { strategy: "lv", position: 100.25 },
    } as const;
    expect(there(view)).toBe(
      "?axis=time&baseline=lqr&hide=passive,lv&zoom=98.5~112&against=before&plots=differences&instant=lv~100.25",
    );
    expect(back(there(view))).toEqual(view);
    const pinned = { ...DEFAULT_VIEW, reference: pinReference("9l2MI3odkPqmWr5qapN1vZ") };
    expect(there(pinned)).toBe("?against=9l2MI3odkPqmWr5qapN1vZ");
    expect(back(there(pinned))).toEqual(pinned);
  });

  it("ignores what makes no sense", () => {
    expect(back("?axis=up&zoom=9~3&hide=,&baseline=&against=lv&plots=all&instant=lv")).toEqual(DEFAULT_VIEW);
  });
});
