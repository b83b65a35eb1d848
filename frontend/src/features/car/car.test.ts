import { describe, expect, it } from "vitest";
import {
  bodyPath,
  windowPath,
  poseAt,
  roadParts,
  type CarPose,
  dimensionsOf,
  drawnCar,
  GROUND,
  roofOf,
  scaleOf,
  seenRoad,
  shiftInto,
} from "./geometry";

const f = (...values: number[]) => new Float32Array(values);
const series = {
  time: f(0, 1),
  position: f(0, 10),
  speed: f(10, 10),
  front_road: f(0, 0.1),
  rear_road: f(0, 0.02),
  front_tyre_load: f(0, 2680),
  rear_tyre_load: f(0, -5000),
  front_deflection: f(0, -0.03),
  rear_deflection: f(0, 0.01),
  front_force: f(0, -5000),
};
const scenario = {
  vehicle: { front_tyre_stiffness: 268_000, rear_tyre_stiffness: 250_000, cg_to_front: 1, cg_to_rear: 2 },
  brake: { wheel_radius: 0.3 },
  mpc: { force_limit: 5000 },
};

const TOGETHER = { ...scenario, road: { rear_axle: "together" } };

describe("the car's pose", () => {
  it("puts a loaded wheel lower over its road and the body a deflection above it", () => {
    const pose = poseAt(series, "distance", 10, scenario, { front: 9000, rear: 4000 });
    expect(pose?.front.wheel).toBeCloseTo(0.09);
    expect(pose?.front.body).toBeCloseTo(0.06);
    expect(pose?.rear.wheel).toBeCloseTo(0.04);
    expect([pose?.front.airborne, pose?.rear.airborne]).toEqual([false, true]);
    expect([pose?.front.force, pose?.rear.force]).toEqual([-5000, 0]);
  });

  it("has a tyre in the air whose load ends where it lifts off", () => {
    const load = -5000.0003; // 32 bits make it −5000
    expect(poseAt(series, "distance", 10, scenario, { front: null, rear: -load })?.rear.airborne).toBe(true);
  });

  it("is nowhere outside the run", () => {
    expect(poseAt(series, "time", 1.5, scenario, { front: null, rear: null })).toBeNull();
  });

  it("takes the road behind the start from the rear axle", () => {
    expect(roadParts(series, { wheelbase: 3, axlesTogether: false })).toEqual([
      {
        under: "car",
        points: [
          [-3, 0],
          [0, 0],
          [10, expect.closeTo(0.1) as number],
        ],
      },
    ]);
  });

  it("draws each axle's own road where both meet it together", () => {
    const [rear, front] = roadParts(series, dimensionsOf(TOGETHER, { front: null, rear: null }));
    expect([rear?.under, front?.under]).toEqual(["rear", "front"]);
    expect(rear?.points).toEqual([
      [-3, 0],
      [7, expect.closeTo(0.02) as number],
    ]);
    expect(front?.points).toEqual([
      [0, 0],
      [10, expect.closeTo(0.1) as number],
    ]);
  });
});

describe("the drawn car", () => {
  const car = dimensionsOf(scenario, { front: 5360, rear: 5000 }); // both tyres are 20 mm shorter than without load
  const scale = scaleOf(920, 5, car); // 40 px a metre, 200 px a metre of height
  const axle = (road: number, wheel: number, body: number, force = 0) => ({
    road: road,
    wheel: wheel,
    body: body,
    force: force,
    airborne: false,
  });
  const pose = (front: CarPose["front"], rear = axle(0, 0, 0)): CarPose => ({
    time: 0,
    position: 0,
    speed: 10,
    front,
    rear,
  });
  const front = (...values: Parameters<typeof axle>) => drawnCar(pose(axle(...values)), car, scale).front;

  it("stands level on round tyres, a wheelbase apart", () => {
    const { front: first, rear, tilt } = drawnCar(pose(axle(0, 0, 0)), car, scale);
    expect(first.x - rear.x).toBeCloseTo(3 * 40);
    expect([first.hub, first.tyre, tilt]).toEqual([GROUND - 12, expect.closeTo(12), 0]);
    expect(first.floor).toBeLessThan(GROUND);
  });

  it("draws heights larger than lengths, and the strut between wheel and body shorter by its compression", () => {
    expect(front(0.1, 0.1, 0.1).hub).toBeCloseTo(GROUND - 12 - 20);
    const [rest, pressed] = [front(0, 0, 0), front(0, 0, -0.04)];
    expect(rest.hub - rest.mount - (pressed.hub - pressed.mount)).toBeCloseTo(8);
  });

  it("flattens a pressed tyre onto the road, and shows a gap only beyond its static compression", () => {
    const gap = (wheel: number) => GROUND - (front(0, wheel, 0).hub + front(0, wheel, 0).tyre);
    expect([gap(-0.02), gap(0), gap(0.02)]).toEqual([expect.closeTo(0), expect.closeTo(0), expect.closeTo(0)]);
    expect(gap(0.03)).toBeCloseTo(2);
  });

  it("draws the largest force as long at every limit, upwards where it lifts the body", () => {
    const longest = front(0, 0, 0, 5000).arrow;
    expect(longest).toBeCloseTo(26);
    expect(front(0, 0, 0, -2500).arrow).toBeCloseTo(-13);
    const stronger = { ...car, forceLimit: 10_000 };
    expect(drawnCar(pose(axle(0, 0, 0, 10_000)), stronger, scaleOf(920, 5, stronger)).front.arrow).toBeCloseTo(longest);
  });

  it("turns nose down over a lower front, and another car stands as far ahead as it is", () => {
    expect(drawnCar(pose(axle(0, 0, -0.02)), car, scale).tilt).toBeCloseTo((Math.atan2(4, 120) * 180) / Math.PI);
    expect(drawnCar(pose(axle(0, 0, 0)), car, scale, 2).front.x).toBeCloseTo(scale.frontX + 80);
  });

  it("is moved down only when its roof would leave the picture", () => {
    expect(shiftInto(drawnCar(pose(axle(0, 0, 0)), car, scale), scale, roofOf(car))).toBe(0);
    expect(shiftInto(drawnCar(pose(axle(0.5, 0.5, 0.5)), car, scale), scale, roofOf(car))).toBeGreaterThan(50);
  });

  it("is a van where its centre of gravity lies as high as one's, with a higher roof and one front window", () => {
    const van = dimensionsOf({ vehicle: { cg_height: 0.8 } }, { front: null, rear: null });
    expect([car.isVan, van.isVan]).toEqual([false, true]);
    expect(bodyPath(van, 40)).not.toBe(bodyPath({ ...van, isVan: false }, 40));
    expect(windowPath(van, 40).match(/M/g)).toHaveLength(1);
    expect(roofOf(van)).toBeGreaterThan(roofOf(car));
  });
});

it("The road that a controller believes in lies elsewhere where its preview errs, and is none without a preview", () => {
  const erring = {
    mpc: { preview: "lookahead" },
    mismatch: { preview_offset: 0.5, preview_delay: 0.1, preview_gain: 0.8 },
  };
  const lv = { reads: ["mpc.preview", "mismatch"] };
  expect(seenRoad(erring, lv, 10)).toEqual({ shift: 1.5, gain: 0.8 });
  expect(seenRoad({ ...erring, mismatch: {} }, lv, 10)).toBeNull();
  expect(seenRoad({ ...erring, mpc: { preview: "none" } }, lv, 10)).toBeNull();
  expect(seenRoad(erring, { reads: ["lqr"] }, 10)).toBeNull();
});
