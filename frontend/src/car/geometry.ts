/** Where the car's parts are, from the time histories. Heights are deviations from standing still. */

import type { Scenario, Series } from "./inputs";
import { valueAt } from "../plots/samples";
import type { Axis } from "../state/address";
import { axisKey } from "../state/scene";
import { metres, metresPerSecond, newtons, newtonsPerMetre, springTravel, type Metres, type MetresPerSecond, type Seconds, seconds } from "../units/brands";
import { numberAt } from "./inputs";

export interface Axle {
  readonly wheel: Metres;
  readonly body: Metres;
  readonly airborne: boolean;
}

export interface CarPose {
  readonly time: Seconds;
  /** Of the front axle, along the road. */
  readonly position: Metres;
  readonly speed: MetresPerSecond;
  readonly front: Axle;
  readonly rear: Axle;
}

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
    const stiffness = newtonsPerMetre(numberAt(scenario, `/vehicle/${end}_tyre_stiffness`, 1));
    // A tyre pressed harder is shorter: the wheel lies that much lower over the road.
    const wheel = metres(road - springTravel(newtons(load), stiffness));
    const limit = loads[end];
    return { wheel, body: metres(wheel + deflection), airborne: limit !== null && load < -limit };
  };
  const [time, position, speed, front, rear] = [read("time"), read("position"), read("speed"), axle("front"), axle("rear")];
  if (time === null || position === null || speed === null || !front || !rear) return null;
  return { time: seconds(time), position: metres(position), speed: metresPerSecond(speed), front, rear };
}

/** The road as the wheels met it: the rear axle's before x = 0, the front's from there on. Pairs of x and height. */
export function roadProfile(series: Series, wheelbase: Metres): readonly (readonly [number, number])[] {
  const { position, front_road: front, rear_road: rear } = series;
  if (!position || !front || !rear) return [];
  const behind = Array.from(position, (x, i) => [x - wheelbase, rear[i] ?? 0] as const).filter(([x]) => x < 0);
  const roadPoints = Array.from(position, (x, i) => [x, front[i] ?? 0] as const);
  return [...behind, ...roadPoints];
}
