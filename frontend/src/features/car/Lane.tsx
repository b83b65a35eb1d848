/** One strategy's car on its road, seen from the side, following the cursor; the others' bodies as outlines. */

import { Box, Group } from "@mantine/core";
import { useMemo } from "react";
import type { Strategy } from "../../api/types";
import { useCursor } from "../../lab/cursor";
import type { ResultView } from "../../lab/resultView";
import { formatNumber } from "../../units/format";
import classes from "./car.module.css";
import ui from "../../ui/ui.module.css";
import { poseAt, roadProfile, type CarPose, type StaticLoads, restingCursor } from "./geometry";
import {
  CLEARANCE,
  dimensionsOf,
  drawnCar,
  GROUND,
  HEIGHT,
  roofOf,
  scaleOf,
  shiftInto,
  type Dimensions,
} from "./layout";
import { Arrow, Body, Ghost, Strut, Wheel } from "./parts";

interface Props {
  readonly resultView: ResultView;
  readonly strategy: Strategy;
  readonly width: number;
  readonly exaggeration: number;
}

export function Lane({ resultView, strategy, width, exaggeration }: Props) {
  const at = Math.min(useCursor(resultView.axis) ?? restingCursor(resultView), resultView.whole[1]);
  const size = useMemo(
    () => dimensionsOf(resultView.shown.scenario, staticLoads(resultView, strategy.id)),
    [resultView, strategy.id],
  );
  const scale = useMemo(() => scaleOf(width, exaggeration, size), [width, exaggeration, size]);
  const { metre, rise } = scale;
  const path = useMemo(() => bodyPath(size, metre), [size, metre]);
  const windows = useMemo(() => windowPath(size, metre), [size, metre]);
  const cg = useMemo(() => ({ x: size.cgToRear * metre, y: (CLEARANCE - size.cgHeight) * metre }), [size, metre]);

  const pose = poseOf(resultView, strategy.id, at);
  if (!pose || width === 0) return <div className={classes.lane} style={{ height: HEIGHT }} />;
  const car = drawnCar(pose, size, scale);
  const others = resultView.strategies.filter(({ id }) => id !== strategy.id);

  return (
    <div className={classes.lane}>
      <Caption strategy={strategy} pose={pose} />
      <svg
        width={width}
        height={HEIGHT}
        role="img"
        aria-label={`${strategy.label} at ${formatNumber(pose.position, 4)} m`}
      >
        <g transform={`translate(0 ${shiftInto(car, scale, roofOf(size))})`}>
          <g transform={`translate(${scale.frontX - pose.position * metre} ${GROUND})`}>
            <Road resultView={resultView} strategy={strategy} wheelbase={size.wheelbase} metre={metre} rise={rise} />
          </g>
          {others.map(({ id, colour }) => {
            const other = poseOf(resultView, id, at);
            return (
              other && (
                <Ghost
                  key={id}
                  car={drawnCar(other, size, scale, other.position - pose.position)}
                  path={path}
                  colour={colour}
                />
              )
            );
          })}
          <g style={{ color: strategy.colour }}>
            <Body car={car} path={path} windows={windows} cg={cg} />
          </g>
          {[car.rear, car.front].map((axle, index) => (
            <g key={index}>
              <Wheel axle={axle} radius={size.radius * metre} rolled={pose.position / size.radius} />
              <Strut axle={axle} isActive={isActive(resultView, strategy.id)} />
              <g transform={`translate(${axle.x + (index === 0 ? -1 : 1) * (size.radius * metre + 5)} ${axle.mount})`}>
                <Arrow length={axle.arrow} />
              </g>
            </g>
          ))}
        </g>
      </svg>
    </div>
  );
}

function staticLoads(resultView: ResultView, id: string): StaticLoads {
  const reference = resultView.summaries[id]?.reference;
  return { front: reference?.front_static_load ?? null, rear: reference?.rear_static_load ?? null };
}

function poseOf(resultView: ResultView, id: string, at: number): CarPose | null {
  const series = resultView.series[id];
  return series ? poseAt(series, resultView.axis, at, resultView.shown.scenario, staticLoads(resultView, id)) : null;
}

/** Whether actuators press in it: a passive car has none. */
const isActive = ({ series }: ResultView, id: string): boolean =>
  series[id]?.front_force?.some((force) => force !== 0) ?? false;

function offTheRoad({ front, rear }: CarPose): string | null {
  if (front.airborne && rear.airborne) return "both wheels off the road";
  return front.airborne ? "front wheel off the road" : rear.airborne ? "rear wheel off the road" : null;
}

function Caption({ strategy, pose }: { readonly strategy: Strategy; readonly pose: CarPose }) {
  const airborne = offTheRoad(pose);
  return (
    <Group gap="0.1rem 0.5rem" pos="absolute" top="0.45rem" left="0.8rem" right="0.8rem" fz="xs">
      <span className={ui.swatch} style={{ background: strategy.colour }} />
      <strong>{strategy.label}</strong>
      <span className={classes.numbers}>
        {formatNumber(3.6 * pose.speed)} km/h · {pose.position.toFixed(1)} m · {pose.time.toFixed(2)} s
      </span>
      {airborne && (
        <Box component="span" fw={600} c="var(--danger)">
          {airborne}
        </Box>
      )}
    </Group>
  );
}

interface RoadProps extends Pick<Props, "resultView" | "strategy"> {
  readonly wheelbase: number;
  readonly metre: number;
  readonly rise: number;
}

function Road({ resultView, strategy, wheelbase, metre, rise }: RoadProps) {
  const series = resultView.series[strategy.id];
  return useMemo(() => {
    const profile = series ? roadProfile(series, wheelbase) : [];
    const points = profile.map(([x, z]) => `${(x * metre).toFixed(1)},${(-z * rise).toFixed(2)}`).join(" ");
    const [start, end] = [profile[0]?.[0] ?? 0, profile.at(-1)?.[0] ?? 0];
    return (
      <>
        <polygon
          points={`${start * metre},${3 * HEIGHT} ${points} ${end * metre},${3 * HEIGHT}`}
          className={classes.earth}
        />
        <polyline points={points} className={classes.road} />
      </>
    );
  }, [series, wheelbase, metre, rise]);
}

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
