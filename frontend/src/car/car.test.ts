import { describe, expect, it } from "vitest";
import { poseAt, roadProfile } from "./geometry";
import { metres } from "../units/brands";

const f = (...values: number[]) => new Float32Array(values);
const series = {
  time: f(0, 1), position: f(0, 10), speed: f(10, 10),
  front_road: f(0, 0.1), rear_road: f(0, 0.02), front_tyre_load: f(0, 2680), rear_tyre_load: f(0, -5000),
  front_deflection: f(0, -0.03), rear_deflection: f(0, 0.01),
};
const scenario = { vehicle: { front_tyre_stiffness: 268_000, rear_tyre_stiffness: 250_000 } };

describe("the car's pose", () => {
  it("puts a loaded wheel lower over its road and the body a deflection above it", () => {
    const pose = poseAt(series, "distance", 10, scenario, { front: 9000, rear: 4000 });
    expect(pose?.front.wheel).toBeCloseTo(0.09);
    expect(pose?.front.body).toBeCloseTo(0.06);
    expect(pose?.rear.wheel).toBeCloseTo(0.04);
    expect([pose?.front.airborne, pose?.rear.airborne]).toEqual([false, true]);
  });

  it("is nowhere outside the run", () => {
    expect(poseAt(series, "time", 1.5, scenario, { front: null, rear: null })).toBeNull();
  });

  it("takes the road behind the start from the rear axle", () => {
    expect(roadProfile(series, metres(3))).toEqual([[-3, 0], [0, 0], [10, expect.closeTo(0.1) as number]]);
  });
});
