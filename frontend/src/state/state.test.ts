import { describe, expect, it } from "vitest";
import { DEFAULT_VIEW, formatAddress, parseAddress } from "./address";
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
  it("is short for the usual view", () => {
    expect(formatAddress({ runId: "abc", slug: null, view: DEFAULT_VIEW })).toBe("/r/abc");
    expect(formatAddress({ runId: null, slug: null, view: DEFAULT_VIEW })).toBe("/");
  });

  it("carries the view there and back", () => {
    const address = { runId: "a_b-1", slug: null, view: { axis: "time", baseline: "lqr", hidden: ["passive", "lv"], zoom: [98.5, 112] } } as const;
    const [path = "", query = ""] = formatAddress(address).split("?");
    expect(query).toBe("axis=time&baseline=lqr&hide=passive,lv&zoom=98.5~112");
    expect(parseAddress(path, `?${query}`)).toEqual(address);
  });

  it("of a shared result is the link alone", () => {
    const view = { ...DEFAULT_VIEW, axis: "time" } as const;
    expect(formatAddress({ runId: null, slug: "x-Y_1", view })).toBe("/s/x-Y_1");
    expect(parseAddress("/s/x-Y_1", "?axis=time")).toEqual({ runId: null, slug: "x-Y_1", view: DEFAULT_VIEW });
    expect(parseAddress("/s/%E0%A4", "").slug).toBe("%E0%A4");
  });

  it("ignores what makes no sense", () => {
    expect(parseAddress("/elsewhere", "?axis=up&zoom=9~3").view).toEqual(DEFAULT_VIEW);
  });
});
