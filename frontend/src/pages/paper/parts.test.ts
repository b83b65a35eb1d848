import { describe, expect, it } from "vitest";
import type { Combination } from "../../api/types";
import { inOrder } from "../../lib/order";
import { ANY, filtered, NO_FILTER, partOf, rankOf } from "./fair";
import { scaleOf, segmentsOf, type Share } from "./Contributions";

const share = (speed: number, preview: number, switching: number): Share => ({
  window: "bump",
  signal: "body_acceleration",
  statistic: "peak",
  total_change: -72,
  speed,
  preview,
  switching,
});

describe("the shares' bars", () => {
  it("stack up to 100 % where all add", () => {
    expect(segmentsOf(share(50, 30, 20))).toEqual([
      { part: "speed", from: 0, to: 50 },
      { part: "preview", from: 50, to: 80 },
      { part: "switching", from: 80, to: 100 },
    ]);
  });

  it("go left of zero where a part takes away, and the scale with them", () => {
    const bars = [share(84, 50, -34), share(50, 30, 20)];
    expect(segmentsOf(share(84, 50, -34)).at(-1)).toEqual({ part: "switching", from: -34, to: 0 });
    expect(scaleOf(bars)).toEqual([-34, 134]);
    expect(scaleOf([])).toEqual([0, 100]);
  });
});

const row = (id: string, part: Partial<Combination>): Combination => ({
  id,
  label: id,
  is: null,
  controller: "mpc",
  speed: "planned",
  preview: "lookahead",
  weights: "switched",
  travel_time: 20,
  metrics: [],
  comfort: {},
  ...part,
});

describe("the combinations", () => {
  const rows = [
    row("lv", {}),
    row("blind", { preview: "none", travel_time: 19 }),
    row("passive", { controller: "passive", speed: "constant", preview: null, weights: null, travel_time: 11 }),
  ];
  const ids = (list: readonly Combination[]) => list.map(({ id }) => id);

  it("are filtered by every part at once; what has no such part drops out", () => {
    expect(ids(filtered(rows, NO_FILTER))).toEqual(["lv", "blind", "passive"]);
    expect(ids(filtered(rows, { ...NO_FILTER, preview: "none" }))).toEqual(["blind"]);
    expect(filtered(rows, { controller: "passive", speed: ANY, preview: "none", weights: ANY })).toEqual([]);
  });

  it("are sorted by numbers as numbers and by parts in their own order", () => {
    expect(ids(inOrder(rows, (each) => each.travel_time))).toEqual(["passive", "blind", "lv"]);
    expect(ids(inOrder(rows, (each) => rankOf(each, "preview"), true))).toEqual(["lv", "blind", "passive"]);
  });

  it("say a part they do not have with a dash", () => {
    expect(rows.map((each) => partOf(each, "weights"))).toEqual(["Switched", "Switched", "–"]);
  });
});
