import { expect, it } from "vitest";
import { bumpSketch, exaggeration } from "./BumpDrawing";

const bump = { start: 10, width: 2, height: 0.1, count: 1, spacing: 3 };
const position = Float32Array.from({ length: 400 }, (_, index) => index / 10);
/** A road 5 mm up with a triangle where the bump is. */
const series = { position, front_road: position.map((x) => 0.005 + Math.max(0, 0.1 * (1 - Math.abs(x - 11)))) };
const on = (change: object) => bumpSketch({ road: { bump: { ...bump, ...change } } }, series);

it("The bump is drawn from the road of the run, over the road where it begins", () => {
  const sketch = on({});
  expect(sketch?.points[0]?.[0]).toBeLessThanOrEqual(-0.6);
  expect(sketch?.points.at(-1)?.[0]).toBeGreaterThanOrEqual(2.6);
  expect(Math.max(...(sketch?.points ?? []).map(([, height]) => height))).toBeCloseTo(0.1, 6);
});

it("Of many bumps the first are drawn, and none from too few samples", () => {
  expect(on({ count: 30 })).toMatchObject({ drawn: 6, count: 30 });
  expect(on({ count: 6, width: 0.1, spacing: 0.1 })).toBeNull();
  expect(on({ height: 0 })).toBeNull();
  expect(bumpSketch({ road: { bump } }, {})).toBeNull();
});

it("Heights are enlarged by a round factor that has room, and never made smaller", () => {
  expect([5.3, 5.5, 40, 400].map((rise) => exaggeration(rise, 54))).toEqual([10, 5, 1, 1]);
});
