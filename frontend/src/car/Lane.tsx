/** One strategy's car on its road, seen from the side, following the cursor. */

import { useMemo } from "react";
import type { Strategy } from "../api/types";
import { cursor } from "../state/cursor";
import type { Scene } from "../state/scene";
import { useStore } from "../state/store";
import { metres, toKmh } from "../units/brands";
import { formatNumber } from "../units/format";
import classes from "./car.module.css";
import { poseAt, roadProfile } from "./geometry";
import { numberAt } from "./inputs";
import { Wheel, Strut } from "./parts";
import { restingCursor } from "./resting";

/** Heights are drawn this much larger than lengths, or nobody would see them. */
export const EXAGGERATION = 5;

const HEIGHT = 116;
const GROUND = 88;
const FRONT_AT = 0.58;
const REST_GAP = 0.42;

interface Props {
  readonly scene: Scene;
  readonly strategy: Strategy;
  readonly width: number;
}

export function Lane({ scene, strategy, width }: Props) {
  const at = useStore(cursor) ?? restingCursor(scene);
  const { scenario } = scene.shown;
  const series = scene.series[strategy.id];
  const reference = scene.summaries[strategy.id]?.reference;
  const front = numberAt(scenario, "/vehicle/cg_to_front", 1);
  const wheelbase = front + numberAt(scenario, "/vehicle/cg_to_rear", 1.9);
  const radius = numberAt(scenario, "/brake/wheel_radius", 0.3);
  const scale = Math.min(42, Math.max(27, width / 26));
  const rise = scale * EXAGGERATION;

  const road = useMemo(() => {
    const points = series ? roadProfile(series, metres(wheelbase)) : [];
    return points.map(([x, z]) => `${(x * scale).toFixed(1)},${(-z * rise).toFixed(2)}`).join(" ");
  }, [series, wheelbase, scale, rise]);

  const loads = { front: reference?.front_static_load ?? null, rear: reference?.rear_static_load ?? null };
  const pose = series ? poseAt(series, scene.axis, Math.min(at, scene.whole[1]), scenario, loads) : null;
  if (!pose || width === 0) return <div className={classes.lane} style={{ height: HEIGHT }} />;

  const frontX = FRONT_AT * width;
  const rearX = frontX - wheelbase * scale;
  const hub = (height: number) => GROUND - height * rise - radius * scale;
  const floor = (height: number) => GROUND - height * rise - (radius + REST_GAP) * scale;
  const [frontFloor, rearFloor] = [floor(pose.front.body), floor(pose.rear.body)];
  const tilt = (Math.atan2(frontFloor - rearFloor, frontX - rearX) * 180) / Math.PI;
  const airborne = pose.front.airborne || pose.rear.airborne;

  return (
    <div className={classes.lane}>
      <div className={classes.caption}>
        <span className={classes.dot} style={{ background: strategy.colour }} />
        <strong>{strategy.label}</strong>
        <span className={classes.numbers}>
          {formatNumber(toKmh(pose.speed))} km/h · {pose.position.toFixed(1)} m · {pose.time.toFixed(2)} s
        </span>
        {airborne && <span className={classes.airborne}>wheel off the road</span>}
      </div>
      <svg width={width} height={HEIGHT} role="img" aria-label={`${strategy.label} at ${formatNumber(pose.position, 4)} m`}>
        <g transform={`translate(${frontX - pose.position * scale} ${GROUND})`}>
          <polyline points={road} className={classes.road} />
        </g>
        <g style={{ color: strategy.colour }}>
          <g transform={`translate(${rearX} ${rearFloor}) rotate(${tilt})`}>
            <path d={bodyPath(wheelbase * scale, scale)} className={classes.body} />
          </g>
          <Strut x={frontX} top={frontFloor} bottom={hub(pose.front.wheel)} />
          <Strut x={rearX} top={rearFloor} bottom={hub(pose.rear.wheel)} />
          <Wheel x={frontX} y={hub(pose.front.wheel)} radius={radius * scale} travelled={pose.position / radius} airborne={pose.front.airborne} />
          <Wheel x={rearX} y={hub(pose.rear.wheel)} radius={radius * scale} travelled={pose.position / radius} airborne={pose.rear.airborne} />
        </g>
      </svg>
    </div>
  );
}

/** A car's outline from the rear axle (0, 0) to the front one, y down, 1 m = `s` px; floor at y = 0. */
function bodyPath(length: number, s: number): string {
  const end = length + 0.85 * s;
  const tail = -0.8 * s;
  return [
    `M ${tail} ${-0.1 * s}`,
    `C ${tail} ${-0.55 * s}, ${tail + 0.1 * s} ${-0.62 * s}, ${tail + 0.35 * s} ${-0.64 * s}`,
    `C ${0.1 * s} ${-1.05 * s}, ${0.35 * s} ${-1.1 * s}, ${0.45 * length} ${-1.1 * s}`,
    `C ${0.66 * length} ${-1.1 * s}, ${0.72 * length} ${-0.78 * s}, ${0.8 * length} ${-0.66 * s}`,
    `C ${length + 0.3 * s} ${-0.6 * s}, ${end} ${-0.5 * s}, ${end} ${-0.12 * s}`,
    `Q ${end} 0, ${end - 0.15 * s} 0 L ${tail + 0.15 * s} 0 Q ${tail} 0, ${tail} ${-0.1 * s} Z`,
  ].join(" ");
}
