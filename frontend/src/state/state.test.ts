import { describe, expect, it } from "vitest";
import { DEFAULT_VIEW, parseSearch, readLabSearch, searchOf, stringifySearch, viewOf, type View } from "./address";
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
    const view = { axis: "time", baseline: "lqr", hidden: ["passive", "lv"], zoom: [98.5, 112] } as const;
    expect(there(view)).toBe("?axis=time&baseline=lqr&hide=passive,lv&zoom=98.5~112");
    expect(back(there(view))).toEqual(view);
  });

  it("ignores what makes no sense", () => {
    expect(back("?axis=up&zoom=9~3&hide=,&baseline=")).toEqual(DEFAULT_VIEW);
  });
});
