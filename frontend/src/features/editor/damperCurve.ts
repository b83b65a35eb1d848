/** A damper's curve while it is edited; the service checks it. */

import type { JsonValue } from "../../api/types";

/** Velocity [m/s], rebound positive, and force [N]. */
export type DamperPoint = readonly [number, number];

/** What suppliers measure at. */
const VELOCITIES = [-1, -0.3, 0.3, 1];

/** The linear damper's force at a few velocities. */
export const linearCurve = (damping: number): readonly DamperPoint[] =>
  VELOCITIES.map((velocity) => [velocity, rounded(velocity * damping)]);

export const curveIn = (value: JsonValue | undefined): readonly DamperPoint[] | null =>
  Array.isArray(value) ? (value as readonly DamperPoint[]) : null;

export const withOrigin = (points: readonly DamperPoint[]): readonly DamperPoint[] =>
  points.some(([velocity]) => velocity === 0) ? points : [...points, [0, 0] as const].sort(([a], [b]) => a - b);

const rounded = (value: number) => Number(value.toPrecision(3));
const between = (low: number, value: number, high: number) => Math.min(high, Math.max(low, value));
/** As it is driven: through 0 at rest, and straight on to either end. */
export function drawnCurve(points: readonly DamperPoint[], end: number) {
  const whole = withOrigin(points);
  const beyond = ([v0, f0]: DamperPoint, [v1, f1]: DamperPoint, x: number) =>
    [x, f1 + ((f1 - f0) / (v1 - v0)) * (x - v1)] as const;
  const [first, second, last, previous] = [whole[0], whole[1], whole.at(-1), whole.at(-2)];
  if (!first || !second || !last || !previous) return { x: [], y: [] };
  const all = [beyond(second, first, -end), ...whole, beyond(previous, last, end)];
  return { x: all.map(([velocity]) => velocity), y: all.map(([, force]) => force) };
}

/** No two points are nearer than this [m/s]. */
const NEAREST = 0.01;

/** One point moved, no further than its neighbours: neither past one of them nor to a force beyond theirs. */
export function movedPoint(
  points: readonly DamperPoint[],
  index: number,
  velocity: number,
  force: number,
): readonly DamperPoint[] {
  const [from] = points[index] ?? [0];
  const others = withOrigin(points).filter((_, at, all) => all[at] !== points[index]);
  const [v0, f0] = others.findLast(([other]) => other < from) ?? [-Infinity, -Infinity];
  const [v1, f1] = others.find(([other]) => other > from) ?? [Infinity, Infinity];
  const moved =
    from === 0
      ? ([0, 0] as const)
      : ([rounded(between(v0 + NEAREST, velocity, v1 - NEAREST)), rounded(between(f0, force, f1))] as const);
  return points.map((point, at) => (at === index ? moved : point));
}

/** One more point, in the middle of the widest gap. */
export function withPoint(points: readonly DamperPoint[]): readonly DamperPoint[] {
  const widths = points.map(([velocity], at) => (points[at + 1]?.[0] ?? velocity) - velocity);
  const at = widths.indexOf(Math.max(...widths));
  const [[v0, f0], [v1, f1]] = [points[at] ?? [-1, -1], points[at + 1] ?? [1, 1]];
  const middle = v0 < 0 && v1 > 0 ? [0, 0] : [rounded((v0 + v1) / 2), rounded((f0 + f1) / 2)];
  return points.toSpliced(at + 1, 0, middle as unknown as DamperPoint);
}
