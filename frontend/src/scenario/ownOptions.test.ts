import { describe, expect, it } from "vitest";
import { changedPointers, valueAt } from "./differences";
import { withoutGone } from "./ownOptions";
import { readSchema } from "./schema";

const DAMPING = { title: "Damping", type: "number", minimum: 0, maximum: 9000, default: 2000, unit: "N·s/m" };
const FORM = readSchema({
  properties: { own: { $ref: "#/$defs/Own", title: "Own controllers", default: {} } },
  $defs: {
    Own: { properties: { mine: { $ref: "#/$defs/own.mine" } } },
    "own.mine": { title: "Mine", properties: { damping: DAMPING } },
  },
});

describe("options of controllers of one's own", () => {
  it("are at their defaults where a scenario lacks them", () => {
    expect(valueAt({ own: {} }, { pointer: "/own/mine/damping", paperValue: 2000 })).toBe(2000);
    expect(changedPointers({ own: {} }, FORM)).toEqual([]);
    expect(changedPointers({ own: { mine: { damping: 3000 } } }, FORM)).toEqual(["/own/mine/damping"]);
  });

  it("are left out of what is sent once their controller is gone", () => {
    const scenario = { road: { seed: 1 }, own: { mine: { damping: 3000, gone: 1 }, other: { gain: 2 } } };
    expect(withoutGone(FORM, scenario)).toEqual({ road: { seed: 1 }, own: { mine: { damping: 3000 } } });
    expect(withoutGone(null, scenario)).toBe(scenario);
  });
});
