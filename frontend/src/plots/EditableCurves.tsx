/** Curves of which one has points that are moved, by pointer or arrow keys. */

import { useElementSize } from "@mantine/hooks";
import type { KeyboardEvent, PointerEvent } from "react";
import { stepBelow } from "../lib/steps";
import { useReleaseAfterKeys } from "../lib/timer";
import { formatExact } from "../units/format";
import classes from "./editableCurves.module.css";

export interface MovablePoint {
  readonly name: string;
  readonly x: number;
  readonly y: number;
  /** Its values with units, for whoever does not see it. */
  readonly text: string;
}

interface Curve {
  readonly name: string;
  readonly x: readonly number[];
  readonly y: readonly number[];
}

type Range = readonly [number, number];

interface Props {
  readonly label: string;
  readonly height: number;
  readonly xRange: Range;
  readonly yRange: Range;
  readonly curves: readonly Curve[];
  /** The one that the points are of. */
  readonly selected: number;
  readonly points: readonly MovablePoint[];
  readonly readOnly: boolean;
  readonly onChoose?: (curve: number) => void;
  readonly onMove: (point: number, x: number, y: number) => void;
  readonly onRelease: () => void;
}

const [LEFT, RIGHT, TOP, BOTTOM] = [44, 14, 16, 18];
/** Of an arrow key, and of one with Shift: as a part of the range. */
const [SMALL, LARGE] = [1 / 120, 1 / 12];
const KEYS: Readonly<Record<string, Range>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Round values over a range, four or so. */
function ticks([low, high]: Range): readonly number[] {
  const step = stepBelow((high - low) / 3);
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, index) =>
    Number(((first + index) * step).toPrecision(12)),
  );
}

export function EditableCurves(props: Props) {
  const { label, height, xRange, yRange, curves, selected, points, readOnly, onChoose, onMove, onRelease } = props;
  const { ref, width } = useElementSize<HTMLDivElement>();
  const releaseSoon = useReleaseAfterKeys(onRelease);
  const scale =
    ([low, high]: Range, from: number, to: number) =>
    (value: number) =>
      from + ((value - low) / (high - low)) * (to - from);
  const [left, right, top, bottom] = [LEFT, width - RIGHT, TOP, height - BOTTOM];
  const [x, y] = [scale(xRange, left, right), scale(yRange, bottom, top)];
  const path = ({ x: xs, y: ys }: Curve) =>
    xs.map((value, index) => `${x(value).toFixed(1)},${y(ys[index] ?? 0).toFixed(1)}`).join(" ");
  const nameAt = ({ x: xs, y: ys }: Curve) => x(xs[ys.indexOf(Math.max(...ys))] ?? 0);

  const drag = (point: number) => (event: PointerEvent<SVGCircleElement>) => {
    const svg = event.currentTarget.ownerSVGElement?.getBoundingClientRect();
    if (!svg || !event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const at = scale([left, right], ...xRange)(event.clientX - svg.left);
    onMove(point, at, scale([bottom, top], ...yRange)(event.clientY - svg.top));
  };
  const step = (index: number, point: MovablePoint) => (event: KeyboardEvent) => {
    const key = KEYS[event.key];
    if (!key || readOnly) return;
    event.preventDefault();
    const size = event.shiftKey ? LARGE : SMALL;
    const [toX, toY] = [key[0] * size * (xRange[1] - xRange[0]), key[1] * size * (yRange[1] - yRange[0])];
    onMove(index, point.x + toX, point.y + toY);
    releaseSoon();
  };

  return (
    <div ref={ref} className={classes.curves} style={{ height }} role="group" aria-label={label}>
      {width > 0 && (
        <svg width={width} height={height}>
          {ticks(xRange).map((value) => (
            <g key={value} transform={`translate(${x(value)})`}>
              <path d={`M 0 ${top} V ${bottom}`} />
              <text y={height - 4} textAnchor="middle">
                {formatExact(value, "1")}
              </text>
            </g>
          ))}
          {ticks(yRange).map((value) => (
            <g key={value} transform={`translate(0 ${y(value)})`}>
              <path d={`M ${left} 0 H ${right}`} />
              <text x={left - 5} textAnchor="end" dominantBaseline="middle">
                {formatExact(value, "1")}
              </text>
            </g>
          ))}
          {curves.map((curve, index) => (
            <g key={curve.name} data-selected={index === selected || undefined} onPointerDown={() => onChoose?.(index)}>
              <polyline points={path(curve)} className={classes.target} />
              <polyline points={path(curve)} className={classes.curve} />
              <text x={nameAt(curve)} y={top - 5} textAnchor="middle">
                {curve.name}
              </text>
            </g>
          ))}
          {points.map((point, index) => (
            <circle
              key={point.name}
              cx={Math.min(right, Math.max(left, x(point.x)))}
              cy={y(point.y)}
              r={6}
              className={classes.point}
              role="slider"
              tabIndex={0}
              aria-label={point.name}
              aria-valuenow={point.x}
              aria-valuetext={point.text}
              aria-disabled={readOnly}
              onPointerDown={(event) => {
                if (!readOnly) event.currentTarget.setPointerCapture(event.pointerId);
              }}
              onPointerMove={drag(index)}
              onPointerUp={onRelease}
              onKeyDown={step(index, point)}
              onBlur={() => releaseSoon.flush()}
            />
          ))}
        </svg>
      )}
    </div>
  );
}
