import { expect, it } from "vitest";
import { drawnCurve, linearCurve, movedPoint, withPoint } from "./DamperCurveRow";

const curve = [
  [-1, -1500],
  [-0.1, -400],
  [0.2, 600],
  [1, 2500],
] as const;

it("A point stops at its neighbours' velocities and forces, and at rest", () => {
  expect(movedPoint(curve, 1, -2, -9000)[1]).toEqual([-0.99, -1500]);
  expect(movedPoint(curve, 2, -0.5, -50)[2]).toEqual([0.01, 0]);
  expect(movedPoint(curve, 3, 2, 3000)[3]).toEqual([2, 3000]);
  expect(movedPoint(withPoint(curve.slice(1, 3)), 1, 0.1, 50)[1]).toEqual([0, 0]);
});

it("Another point stands in the middle of the widest gap, at rest where that is around it", () => {
  expect(withPoint(curve)[1]).toEqual([-0.55, -950]);
  expect(withPoint(linearCurve(1000).slice(1, 3))[1]).toEqual([0, 0]);
});

it("It is drawn through 0 and straight on beyond its outer points", () => {
  const { x, y } = drawnCurve(curve, 2);
  expect(x).toEqual([-2, -1, -0.1, 0, 0.2, 1, 2]);
  expect(y.map(Math.round)).toEqual([-2722, -1500, -400, 0, 600, 2500, 4875]);
});
