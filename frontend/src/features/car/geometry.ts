/** Where the car's parts are, from the time histories. Heights are deviations from standing still. */

import type { Series } from "../../api/decode";
import type { Scenario } from "../../api/types";
import { numberAt } from "../../scenario/path";
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

/** The road as the wheels met it: the rear axle's before x = 0, the front's from there on. Pairs of x and height. */
export function roadProfile(series: Series, wheelbase: number): readonly (readonly [number, number])[] {
  const { position, front_road: front, rear_road: rear } = series;
  if (!position || !front || !rear) return [];
  const behind = Array.from(position, (x, i) => [x - wheelbase, rear[i] ?? 0] as const).filter(([x]) => x < 0);
  const roadPoints = Array.from(position, (x, i) => [x, front[i] ?? 0] as const);
  return [...behind, ...roadPoints];
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
