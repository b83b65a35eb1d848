/** Where the car's parts are, from the time histories (heights are deviations from standing still), and on the screen [px], y downwards. */

import type { Series } from "../../api/decode";
import type { Scenario, Strategy } from "../../api/types";
import { getAt, numberAt } from "../../scenario/path";
import { valueAt } from "../../lib/samples";
import type { Axis } from "../../lab/address";
import { axisKey, type ResultView } from "../../lab/resultView";
import { stagedStrategy } from "../../plots/shapes";

export interface Axle {
  /** Heights [m]. */
  readonly road: number;
  readonly wheel: number;
  readonly body: number;
  /** Of the actuator: it lifts the body and presses the wheel down [N]. */
  readonly force: number;
  /** The tyre is off the road, or pulls on it where it cannot lift off. */
  readonly airborne: boolean;
}

export interface CarPose {
  /** [s] */
  readonly time: number;
  /** Of the front axle, along the road [m]. */
  readonly position: number;
  /** [m/s] */
  readonly speed: number;
  readonly front: Axle;
  readonly rear: Axle;
}

/** Of a number, whatever rounding to 32 bits leaves of it. */
const FLOAT32 = 1 - 1e-6;

export interface StaticLoads {
  readonly front: number | null;
  readonly rear: number | null;
}

/** The car at one point of the shared axis; `null` outside the run. */
export function poseAt(series: Series, axis: Axis, at: number, scenario: Scenario, loads: StaticLoads): CarPose | null {
  const samples = series[axisKey(axis)];
  if (!samples) return null;
  const read = (signal: string): number | null => {
    const values = series[signal];
    return values ? valueAt(samples, values, at) : null;
  };
  const axle = (end: "front" | "rear"): Axle | null => {
    const [road, load, deflection] = [read(`${end}_road`), read(`${end}_tyre_load`), read(`${end}_deflection`)];
    if (road === null || load === null || deflection === null) return null;
    // A tyre pressed harder is shorter: the wheel lies that much lower over the road.
    const wheel = road - load / numberAt(scenario, `/vehicle/${end}_tyre_stiffness`, 1);
    const limit = loads[end];
    const airborne = limit !== null && load <= -limit * FLOAT32;
    return { road, wheel, body: wheel + deflection, force: read(`${end}_force`) ?? 0, airborne };
  };
  const [time, position, speed, front, rear] = [
    read("time"),
    read("position"),
    read("speed"),
    axle("front"),
    axle("rear"),
  ];
  if (time === null || position === null || speed === null || !front || !rear) return null;
  return { time, position, speed, front, rear };
}

/** The road under the whole car, or under one axle where both meet the same road together: pairs of x and height. */
export interface RoadPart {
  readonly under: "car" | "front" | "rear";
  readonly points: readonly (readonly [number, number])[];
}

/** The road as the wheels met it; of the whole car the rear axle's before x = 0, the front's from there on. */
export function roadParts(
  series: Series,
  { wheelbase, axlesTogether }: Pick<Dimensions, "wheelbase" | "axlesTogether">,
): readonly RoadPart[] {
  const { position, front_road: front, rear_road: rear } = series;
  if (!position || !front || !rear) return [];
  const underRear = Array.from(position, (x, i) => [x - wheelbase, rear[i] ?? 0] as const);
  const underFront = Array.from(position, (x, i) => [x, front[i] ?? 0] as const);
  if (!axlesTogether) return [{ under: "car", points: [...underRear.filter(([x]) => x < 0), ...underFront] }];
  return [
    { under: "rear", points: underRear },
    { under: "front", points: underFront },
  ];
}

/** Where a strategy's preview places the road, where that is elsewhere; noise and resolution have no place. */
export interface SeenRoad {
  /** Seen so much too far away [m]. */
  readonly shift: number;
  /** Heights seen over the true ones. */
  readonly gain: number;
}

/** `null` where nothing of the road ahead is seen, or all of it as it is. */
export function seenRoad(scenario: Scenario, { reads }: Pick<Strategy, "reads">, speed: number): SeenRoad | null {
  const ours = ["mpc", "lqr"].find((part) => reads.some((each) => each === part || each === `${part}.preview`));
  if (ours === undefined || getAt(scenario, `/${ours}/preview`) !== "lookahead") return null;
  const error = (name: string, otherwise: number) => numberAt(scenario, `/mismatch/preview_${name}`, otherwise);
  const seen = { shift: error("offset", 0) + error("delay", 0) * speed, gain: error("gain", 1) };
  return seen.shift === 0 && seen.gain === 1 ? null : seen;
}

/** Where the car stands until somebody moves the cursor: on its way up the bump. */
export function restingCursor(resultView: ResultView): number {
  const id = stagedStrategy(resultView.summaries, resultView.ids);
  const bump = id === undefined ? undefined : resultView.summaries[id]?.stages.find(({ stage }) => stage === "bump");
  if (!bump) return resultView.range[0];
  const [from, to] =
    resultView.axis === "distance" ? [bump.start_position, bump.end_position] : [bump.start_time, bump.end_time];
  return from + 0.22 * (to - from);
}

export const HEIGHT = 124;
/** The road's height 0. */
export const GROUND = 100;
/** The longest force arrow, as a part of a metre of the road. */
const FORCE_LENGTH = 0.65;
const FRONT_AT = 0.58;
/** The upper end of spring and damper over the floor [m]. */
const MOUNT = 0.6;
/** A car whose centre of gravity lies higher is a van [m]: the sedans and the SUV of the vehicle list stay below 0.65. */
const VAN_CG = 0.7;
/** A tyre keeps this part of its radius, however hard it is pressed. */
const FLATTEST = 0.35;
const HEADROOM = 6;
/** The floor over the road, where heights are not exaggerated at all [m]. */
export const CLEARANCE = 0.16;

/** What the scenario says of the car [m, N]. */
export interface Dimensions {
  readonly wheelbase: number;
  /** Both axles meet the road at the same instant. */
  readonly axlesTogether: boolean;
  readonly cgToRear: number;
  readonly cgHeight: number;
  readonly radius: number;
  readonly isVan: boolean;
  /** Of both dampers. */
  readonly reboundRatio: number;
  /** How much shorter the tyres are than without load. */
  readonly compression: { readonly front: number; readonly rear: number };
  readonly forceLimit: number;
}

export function dimensionsOf(scenario: Scenario, loads: StaticLoads): Dimensions {
  const number = (field: `/${string}`, otherwise: number) => numberAt(scenario, field, otherwise);
  const cgToRear = number("/vehicle/cg_to_rear", 1.9);
  const compressed = (end: "front" | "rear") => (loads[end] ?? 0) / number(`/vehicle/${end}_tyre_stiffness`, 268_000);
  return {
    wheelbase: number("/vehicle/cg_to_front", 1) + cgToRear,
    axlesTogether: getAt(scenario, "/road/rear_axle") === "together",
    cgToRear,
    cgHeight: number("/vehicle/cg_height", 0.54),
    isVan: number("/vehicle/cg_height", 0.54) > VAN_CG,
    reboundRatio: number("/vehicle/rebound_ratio", 1),
    radius: number("/brake/wheel_radius", 0.3),
    compression: { front: compressed("front"), rear: compressed("rear") },
    forceLimit: number("/mpc/force_limit", 5000),
  };
}

export interface Scale {
  /** Of a metre along the road and of the car itself. */
  readonly metre: number;
  /** Of a metre of the road's, the wheels' and the body's movement up and down. */
  readonly rise: number;
  /** The body's floor over the road at rest [m]; the larger movements are drawn, the more room they need. */
  readonly clearance: number;
  readonly newton: number;
  readonly frontX: number;
}

export function scaleOf(width: number, exaggeration: number, { forceLimit, wheelbase }: Dimensions): Scale {
  const metre = Math.min(46, Math.max(34, width / 23)) * Math.min(1, 5 / wheelbase);
  return {
    metre,
    rise: metre * exaggeration,
    clearance: CLEARANCE + 0.05 * exaggeration,
    newton: (FORCE_LENGTH * metre) / forceLimit,
    frontX: FRONT_AT * width,
  };
}

export interface DrawnAxle {
  readonly x: number;
  readonly hub: number;
  /** From the hub down to the tyre's lowest point. */
  readonly tyre: number;
  readonly floor: number;
  /** The upper end of spring and damper. */
  readonly mount: number;
  /** Length of the force arrow; up is positive. */
  readonly arrow: number;
  readonly airborne: boolean;
}

export interface DrawnCar {
  readonly front: DrawnAxle;
  readonly rear: DrawnAxle;
  /** Of the body, clockwise [°]. */
  readonly tilt: number;
}

/** The car with its front axle `lead` metres before the place where the followed one has it. */
export function drawnCar(pose: CarPose, car: Dimensions, scale: Scale, lead = 0): DrawnCar {
  const { metre, rise, clearance, newton } = scale;
  const radius = car.radius * metre;
  const axle = ({ road, wheel, body, force, airborne }: Axle, x: number, compression: number): DrawnAxle => {
    const toRoad = radius + (wheel - road) * rise;
    const floor = GROUND - body * rise - clearance * metre;
    return {
      x,
      hub: GROUND - wheel * rise - radius,
      tyre: Math.max(FLATTEST * radius, Math.min(toRoad, radius + compression * rise)),
      floor,
      mount: floor - MOUNT * metre,
      arrow: force * newton,
      airborne,
    };
  };
  const frontX = scale.frontX + lead * metre;
  const front = axle(pose.front, frontX, car.compression.front);
  const rear = axle(pose.rear, frontX - car.wheelbase * metre, car.compression.rear);
  return { front, rear, tilt: (Math.atan2(front.floor - rear.floor, front.x - rear.x) * 180) / Math.PI };
}

/** The roof over the floor [m]. */
export const roofOf = ({ isVan }: Pick<Dimensions, "isVan">): number => (isVan ? 1.5 : 1.12);

/** How far everything is moved down, that the roof stays in the picture. */
export const shiftInto = ({ front, rear }: DrawnCar, { metre }: Scale, roof: number): number =>
  Math.max(0, HEADROOM - Math.min(front.floor, rear.floor) + roof * metre);

type Outline = Pick<Dimensions, "wheelbase" | "radius" | "isVan">;

const [TAIL, NOSE] = [-0.78, 0.82];

/** The body's outline from the rear axle (0, 0) to the front one, y down, 1 m = `s` px; its floor is at y = 0. */
export function bodyPath({ wheelbase, radius, isVan }: Outline, s: number): string {
  const point = (x: number, up: number) => `${(x * s).toFixed(1)} ${(-up * s).toFixed(1)}`;
  const arch = radius * 1.22;
  const [nose, hood, roof] = [wheelbase + NOSE, 0.79 * wheelbase, 0.46 * wheelbase];
  const top = isVan
    ? [
        `L ${point(TAIL, 1.3)} Q ${point(TAIL, 1.5)}, ${point(TAIL + 0.25, 1.5)}`,
        `L ${point(wheelbase - 0.1, 1.5)} Q ${point(wheelbase + 0.25, 1.48)}, ${point(wheelbase + 0.42, 0.86)}`,
        `Q ${point(nose, 0.7)}, ${point(nose, 0.3)}`,
      ]
    : [
        `C ${point(TAIL - 0.04, 0.5)}, ${point(TAIL + 0.02, 0.66)}, ${point(TAIL + 0.2, 0.68)}`,
        `L ${point(-0.28, 0.7)}`,
        `C ${point(0.1, 0.98)}, ${point(0.28, 1.12)}, ${point(roof, 1.12)}`,
        `C ${point(roof + 0.45, 1.12)}, ${point(hood - 0.3, 0.84)}, ${point(hood, 0.7)}`,
        `C ${point(wheelbase + 0.2, 0.65)}, ${point(nose - 0.02, 0.56)}, ${point(nose, 0.3)}`,
      ];
  return [
    `M ${point(TAIL, 0.12)}`,
    ...top,
    `L ${point(nose, 0.1)} Q ${point(nose, 0)}, ${point(nose - 0.12, 0)}`,
    `L ${point(wheelbase + arch, 0)} A ${arch * s} ${arch * s} 0 0 0 ${point(wheelbase - arch, 0)}`,
    `L ${point(arch, 0)} A ${arch * s} ${arch * s} 0 0 0 ${point(-arch, 0)}`,
    `L ${point(TAIL + 0.12, 0)} Q ${point(TAIL, 0)}, ${point(TAIL, 0.12)} Z`,
  ].join(" ");
}

export function windowPath({ wheelbase, isVan }: Outline, s: number): string {
  const point = (x: number, up: number) => `${(x * s).toFixed(1)} ${(-up * s).toFixed(1)}`;
  if (isVan)
    return [
      `M ${point(wheelbase - 0.62, 0.86)} V ${(-1.32 * s).toFixed(1)} H ${((wheelbase - 0.1) * s).toFixed(1)}`,
      `Q ${point(wheelbase + 0.12, 1.3)}, ${point(wheelbase + 0.28, 0.86)} Z`,
    ].join(" ");
  const [pillar, roof, hood] = [0.4 * wheelbase, 0.46 * wheelbase, 0.79 * wheelbase];
  return [
    `M ${point(0.02, 0.74)} C ${point(0.2, 0.95)}, ${point(0.35, 1.03)}, ${point(pillar - 0.04, 1.04)} L ${point(pillar - 0.04, 0.74)} Z`,
    `M ${point(pillar + 0.04, 1.04)} L ${point(roof, 1.04)} C ${point(roof + 0.35, 1.03)}, ${point(hood - 0.35, 0.86)}, ${point(hood - 0.12, 0.74)} L ${point(pillar + 0.04, 0.74)} Z`,
  ].join(" ");
}
