import { expect, test } from "vitest";
import type { Summary } from "../../api/types";
import { judgedHere } from "./judged";

const PEAK = "bump.body_acceleration.peak";
const drove = (peak: number, airborne: number) =>
  ({
    comfort: {},
    metrics: { bump: { body_acceleration: { peak } } },
    events: { airborne_ms: airborne },
  }) as unknown as Summary;
const SUMMARIES = { lv: drove(1, 0), lqr: drove(2, 5), passive: drove(4, 9) };

test("one road is judged as the service judges it", () => {
  const results = judgedHere(
    SUMMARIES,
    [
      { metric: PEAK, max: 1 },
      { metric: PEAK, min: 4, strategies: ["passive"] },
      { metric: PEAK, max_change: -75 },
      { metric: "events.airborne_ms", max: 0, strategies: ["lv"] },
      { metric: "comfort.weighted_rms", max: 9, strategies: ["lv"] },
    ],
    "passive",
  );
  expect(results.map(({ strategy, result, value }) => [strategy, result, value])).toEqual([
    ["lv", "pass", 1],
    ["lqr", "fail", 2],
    ["passive", "pass", 4],
    ["lv", "pass", -75],
    ["lqr", "fail", -50],
    ["lv", "pass", 0],
    ["lv", "fail", null],
  ]);
  expect(results[3]).toMatchObject({ metric: PEAK, max: null, max_change: -75, baseline: "passive" });
  const [alone] = judgedHere({ passive: drove(4, 9) }, [{ metric: PEAK, max: 4 }], "passive");
  expect([alone?.strategy, alone?.result]).toEqual(["passive", "pass"]);
});
