/** The parts of the drawn car. */

import { memo } from "react";
import classes from "./car.module.css";
import type { DrawnAxle, DrawnCar } from "./layout";

interface WheelProps {
  readonly axle: DrawnAxle;
  readonly radius: number;
  /** Angle rolled so far [rad]. */
  readonly rolled: number;
}

/** The tyre is as long below the hub as its load leaves it; off the road there is a gap beneath it. */
export function Wheel({ axle: { x, hub, tyre, airborne }, radius, rolled }: WheelProps) {
  const rim = radius * 0.58;
  return (
    <g transform={`translate(${x} ${hub})`} data-airborne={airborne || undefined} className={classes.wheel}>
      <path
        d={`M ${-radius} 0 A ${radius} ${radius} 0 0 1 ${radius} 0 A ${radius} ${tyre} 0 0 1 ${-radius} 0 Z`}
        className={classes.tyre}
      />
      <circle r={rim} className={classes.rim} />
      <g transform={`rotate(${((rolled * 180) / Math.PI) % 360})`} className={classes.spoke}>
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
export function Strut({ axle: { x, hub, mount }, isActive }: StrutProps) {
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
    <g transform={`translate(${x} 0)`} className={classes.strut}>
      <path d={path} className={classes.halo} />
      <path d={path} />
      {isActive && <path d={`M 0 ${top} V ${hub}`} className={classes.actuator} />}
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
    <g className={classes.force}>
      <path d={`M 0 0 V ${-length + head / 2}`} />
      <path d={`M -4 ${-length + head} H 4 L 0 ${-length} Z`} />
    </g>
  );
}

interface BodyProps {
  readonly car: DrawnCar;
  readonly path: string;
  readonly windows: string;
  readonly cg: { readonly x: number; readonly y: number };
}

export function Body({ car: { rear, tilt }, ...shape }: BodyProps) {
  return (
    <g transform={`translate(${rear.x} ${rear.floor}) rotate(${tilt})`}>
      <Shell path={shape.path} windows={shape.windows} x={shape.cg.x} y={shape.cg.y} />
    </g>
  );
}

interface ShellProps {
  readonly path: string;
  readonly windows: string;
  readonly x: number;
  readonly y: number;
}

const CG = 4;

/** Outline, windows and the centre of gravity's mark; the same in every frame. */
const Shell = memo(function Shell({ path, windows, x, y }: ShellProps) {
  return (
    <>
      <path d={path} className={classes.body} />
      <path d={windows} className={classes.window} />
      <g transform={`translate(${x} ${y})`} className={classes.cg}>
        <circle r={CG} />
        <path d={`M 0 0 V ${-CG} A ${CG} ${CG} 0 0 1 ${CG} 0 Z M 0 0 V ${CG} A ${CG} ${CG} 0 0 1 ${-CG} 0 Z`} />
      </g>
    </>
  );
});

interface GhostProps {
  readonly car: DrawnCar;
  readonly path: string;
  readonly colour: string;
}

/** Another strategy's body, as a thin line in its colour. */
export function Ghost({ car: { rear, tilt }, path, colour }: GhostProps) {
  return (
    <path
      transform={`translate(${rear.x} ${rear.floor}) rotate(${tilt})`}
      d={path}
      stroke={colour}
      className={classes.ghost}
    />
  );
}
