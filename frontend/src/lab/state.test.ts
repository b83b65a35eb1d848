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
      requirements: [
        { metric: "bump.body_acceleration.peak", max: 3 },
        { metric: "travel_time", min: 1.5e-7, strategies: ["lv", "lqr"] },
        { metric: "bump.rear_tyre_load.peak", max_change: -20.5, strategies: ["lv"] },
        { metric: "events.airborne_ms", max_change: 0 },
      ],
    } as const;
    expect(there(view)).toBe(
      "?axis=time&baseline=lqr&hide=passive,lv&zoom=98.5~112&against=before&plots=differences&instant=lv~100.25" +
        "&require=bump.body_acceleration.peak%3C3;lv,lqr:travel_time%3E1.5e-7;lv:bump.rear_tyre_load.peak%3C-20.5%25" +
        ";events.airborne_ms%3C%2B0%25",
    );
    expect(back(there(view))).toEqual(view);
    const pinned = { ...DEFAULT_VIEW, reference: pinReference("9l2MI3odkPqmWr5qapN1vZ") };
    expect(there(pinned)).toBe("?against=9l2MI3odkPqmWr5qapN1vZ");
    expect(back(there(pinned))).toEqual(pinned);
  });

  it("ignores what makes no sense", () => {
    expect(
      back("?axis=up&zoom=9~3&hide=,&baseline=&against=lv&plots=all&instant=lv&require=a<;b=3;c>-5%25%25"),
    ).toEqual(DEFAULT_VIEW);
  });
});
