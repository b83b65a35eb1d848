import { describe, expect, it } from "vitest";
import type { Combination } from "../../api/types";
import { inOrder } from "../../lib/order";
import { ANY, filtered, NO_FILTER, partOf, rankOf } from "./Contributions";

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
