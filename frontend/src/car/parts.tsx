/** Wheel and strut of the drawn car. */

import classes from "./car.module.css";

interface WheelProps {
  readonly x: number;
  readonly y: number;
  readonly radius: number;
  /** Angle rolled so far [rad]. */
  readonly travelled: number;
  readonly airborne: boolean;
}

export function Wheel({ x, y, radius, travelled, airborne }: WheelProps) {
  const angle = (travelled * 180) / Math.PI;
  return (
    <g transform={`translate(${x} ${y}) rotate(${angle % 360})`} data-airborne={airborne || undefined} className={classes.wheel}>
      <circle r={radius} className={classes.tyre} />
      <circle r={radius * 0.52} className={classes.rim} />
      <line x1={-radius * 0.5} x2={radius * 0.5} className={classes.spoke} />
      <line y1={-radius * 0.5} y2={radius * 0.5} className={classes.spoke} />
    </g>
  );
}

const COILS = 6;

export function Strut({ x, top, bottom }: { readonly x: number; readonly top: number; readonly bottom: number }) {
  const step = (bottom - top) / (COILS + 1);
  const points = Array.from({ length: COILS }, (_, i) => `${x + (i % 2 === 0 ? 4 : -4)},${top + (i + 1) * step}`);
  return <polyline points={[`${x},${top}`, ...points, `${x},${bottom}`].join(" ")} className={classes.strut} />;
}
