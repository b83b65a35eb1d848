/** One strategy's car on its road, seen from the side, following the cursor; the others' bodies as outlines. */

import { Box, Group } from "@mantine/core";
import { useMemo, memo, useId, type ReactNode } from "react";
import { type Strategy } from "../../api/types";
import { useCursor } from "../../lab/cursor";
import { type ResultView } from "../../lab/resultView";
import { formatNumber } from "../../units/format";
import classes from "./car.module.css";
import ui from "../../ui/ui.module.css";
import {
  bodyPath,
  windowPath,
  poseAt,
  roadParts,
  type CarPose,
  type StaticLoads,
  restingCursor,
  CLEARANCE,
  dimensionsOf,
  drawnCar,
  GROUND,
  HEIGHT,
  roofOf,
  scaleOf,
  seenRoad,
  shiftInto,
  type DrawnAxle,
  type DrawnCar,
  type RoadPart,
  type SeenRoad,
} from "./geometry";

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
  const series = resultView.series[strategy.id];
  const roads = useMemo(() => (series ? roadParts(series, size) : []), [series, size]);

  const pose = poseOf(resultView, strategy.id, at);
  if (!pose || width === 0) return <div className={classes.lane} style={{ height: HEIGHT }} />;
  const car = drawnCar(pose, size, scale);
  const seen = seenRoad(resultView.shown.scenario, strategy, pose.speed);
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
          {roads.map((part) => (
            <Under key={part.under} {...{ part, car, width }}>
              <g transform={`translate(${scale.frontX - pose.position * metre} ${GROUND})`}>
                <Road {...{ part, metre, rise, seen }} colour={strategy.colour} />
              </g>
            </Under>
          ))}
          {others.map(({ id, colour }) => {
            const other = poseOf(resultView, id, at);
            return (
              other && (
                <path
                  key={id}
                  transform={bodyPlace(drawnCar(other, size, scale, other.position - pose.position))}
                  d={path}
                  stroke={colour}
                  fill="none"
                  strokeWidth={1.1}
                  strokeOpacity={0.75}
                />
              )
            );
          })}
          <g style={{ color: strategy.colour }} transform={bodyPlace(car)}>
            <Body {...{ path, windows }} x={size.cgToRear * metre} y={(CLEARANCE - size.cgHeight) * metre} />
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
      <Box component="span" c="dimmed">
        {formatNumber(3.6 * pose.speed)} km/h · {pose.position.toFixed(1)} m · {pose.time.toFixed(2)} s
      </Box>
      {airborne && (
        <Box component="span" fw={600} c="var(--danger)">
          {airborne}
        </Box>
      )}
    </Group>
  );
}

interface WheelProps {
  readonly axle: DrawnAxle;
  readonly radius: number;
  /** Angle rolled so far [rad]. */
  readonly rolled: number;
}

/** The tyre is as long below the hub as its load leaves it; off the road there is a gap beneath it. */
function Wheel({ axle: { x, hub, tyre, airborne }, radius, rolled }: WheelProps) {
  const rim = radius * 0.58;
  return (
    <g transform={`translate(${x} ${hub})`} data-airborne={airborne || undefined}>
      <path
        d={`M ${-radius} 0 A ${radius} ${radius} 0 0 1 ${radius} 0 A ${radius} ${tyre} 0 0 1 ${-radius} 0 Z`}
        fill={airborne ? "var(--danger)" : "var(--faint)"}
      />
      <circle r={rim} fill="var(--surface)" />
      <g transform={`rotate(${((rolled * 180) / Math.PI) % 360})`} stroke="var(--faint)" strokeWidth={1.2}>
        <path d={`M ${-rim} 0 H ${rim} M 0 ${-rim} V ${rim}`} />
      </g>
    </g>
  );
}

const COILS = 5;
/** Half the distance between spring and damper, and half the width of either. */
const [APART, HALF] = [4.5, 3];

interface StrutProps {
  readonly axle: DrawnAxle;
  readonly isActive: boolean;
}

/** Spring and damper beside each other between wheel and body, where there is one the actuator between them. */
function Strut({ axle: { x, hub, mount }, isActive }: StrutProps) {
  const top = Math.min(mount, hub - 5);
  const middle = (hub + top) / 2;
  const step = (hub - top) / (COILS + 1);
  const coils = Array.from(
    { length: COILS },
    (_, i) => `L ${-APART + (i % 2 === 0 ? HALF : -HALF)} ${top + (i + 1) * step}`,
  );
  const spring = `M ${-APART} ${top} ${coils.join(" ")} L ${-APART} ${hub}`;
  // The piston hangs from the body in a cylinder on the wheel.
  const cylinder = Math.max(middle - 3, top + 1);
  const damper = `M ${APART} ${top} V ${middle} M ${APART - 2} ${middle} H ${APART + 2} M ${APART - HALF} ${cylinder} V ${hub - 2} H ${APART + HALF} V ${cylinder} M ${APART} ${hub - 2} V ${hub}`;
  const ends = `M ${-APART - 2} ${top} H ${APART + 2} M ${-APART - 2} ${hub} H ${APART + 2}`;
  const path = `${ends} ${spring} ${damper}`;
  return (
    <g transform={`translate(${x} 0)`} fill="none" stroke="var(--text)" strokeWidth={1.2} strokeLinejoin="round">
      <path d={path} stroke="var(--surface)" strokeWidth={2.8} strokeOpacity={0.8} />
      <path d={path} />
      {isActive && <path d={`M 0 ${top} V ${hub}`} stroke="var(--accent)" strokeWidth={3} />}
    </g>
  );
}

/** Shorter ones would only flicker. */
const SHORTEST = 3;

/** An arrow from (0, 0), `length` px up, or down if that is negative. */
export function Arrow({ length }: { readonly length: number }) {
  if (Math.abs(length) < SHORTEST) return null;
  const head = Math.sign(length) * Math.min(6, Math.abs(length));
  return (
    <g fill="var(--text)">
      <path d={`M 0 0 V ${-length + head / 2}`} stroke="var(--text)" strokeWidth={2.4} />
      <path d={`M -4 ${-length + head} H 4 L 0 ${-length} Z`} />
    </g>
  );
}

const bodyPlace = ({ rear, tilt }: DrawnCar) => `translate(${rear.x} ${rear.floor}) rotate(${tilt})`;

interface BodyProps {
  readonly path: string;
  readonly windows: string;
  readonly x: number;
  readonly y: number;
}

const CG = 4;

/** Outline, windows and the centre of gravity's mark; the same in every frame. */
const Body = memo(function Body({ path, windows, x, y }: BodyProps) {
  return (
    <>
      <path
        d={path}
        fill="currentColor"
        fillOpacity={0.2}
        stroke="currentColor"
        strokeWidth={1.6}
        strokeLinejoin="round"
      />
      <path d={windows} fill="var(--surface)" fillOpacity={0.75} />
      <g transform={`translate(${x} ${y})`} fill="var(--text)">
        <circle r={CG} fill="var(--surface)" stroke="var(--text)" />
        <path d={`M 0 0 V ${-CG} A ${CG} ${CG} 0 0 1 ${CG} 0 Z M 0 0 V ${CG} A ${CG} ${CG} 0 0 1 ${-CG} 0 Z`} />
      </g>
    </>
  );
});

/** The road under a car, and dashed over it where the controller believes it to be. */
interface UnderProps {
  readonly part: RoadPart;
  readonly car: DrawnCar;
  readonly width: number;
  readonly children: ReactNode;
}

/** Clips a part of the road that is under one axle alone at the car’s middle. */
function Under({ part: { under }, car: { front, rear }, width, children }: UnderProps) {
  const id = useId();
  if (under === "car") return children;
  const middle = (front.x + rear.x) / 2;
  const [x, across] = under === "rear" ? [0, middle] : [middle, width - middle];
  return (
    <>
      <clipPath id={id}>
        <rect x={x} y={-HEIGHT} width={Math.max(0, across)} height={4 * HEIGHT} />
      </clipPath>
      <g clipPath={`url(#${id})`} data-road={under}>
        {children}
      </g>
    </>
  );
}

interface RoadProps {
  readonly part: RoadPart;
  readonly colour: string;
  readonly metre: number;
  readonly rise: number;
  readonly seen: SeenRoad | null;
}

/** The road, and dashed over it where the controller believes it to be. */
function Road({ part: { points: profile }, colour, metre, rise, seen }: RoadProps) {
  const [points, road] = useMemo(() => {
    const line = profile.map(([x, z]) => `${(x * metre).toFixed(1)},${(-z * rise).toFixed(2)}`).join(" ");
    const [start, end] = [profile[0]?.[0] ?? 0, profile.at(-1)?.[0] ?? 0];
    const drawn = (
      <>
        <polygon
          points={`${start * metre},${3 * HEIGHT} ${line} ${end * metre},${3 * HEIGHT}`}
          fill="var(--line)"
          fillOpacity={0.55}
        />
        <polyline points={line} fill="none" stroke="var(--muted)" strokeWidth={2} strokeLinejoin="round" />
      </>
    );
    return [line, drawn] as const;
  }, [profile, metre, rise]);
  return (
    <>
      {road}
      {seen && (
        <polyline
          data-seen
          points={points}
          transform={`translate(${seen.shift * metre} 0) scale(1 ${seen.gain})`}
          fill="none"
          stroke={colour}
          strokeWidth={1.6}
          strokeDasharray="5 4"
          vectorEffect="non-scaling-stroke"
        />
      )}
    </>
  );
}
