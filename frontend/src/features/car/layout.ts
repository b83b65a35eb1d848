/** Where the parts of the drawn car lie on the screen [px], y downwards. */

import type { Axle, CarPose, StaticLoads } from "./geometry";
import type { Scenario } from "../../api/types";
import { numberAt } from "../../scenario/path";

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
