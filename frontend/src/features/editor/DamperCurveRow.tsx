/** A damper as its supplier gives it: its force at a few velocities, drawn; points are dragged, or typed. */

import { ActionIcon, Box, Button, Switch } from "@mantine/core";
import { Fragment, useId } from "react";
import { useEdit, useFromScenario, useLab } from "../../lab/context";
import { EditableCurves } from "../../plots/EditableCurves";
import { valueAt } from "../../scenario/differences";
import { child, numberAt, setAt } from "../../scenario/path";
import type { DataField } from "../../scenario/schema";
import { Icon } from "../../ui/icons";
import { formatExact } from "../../units/format";
import { FieldFrame, useLeaf } from "./FieldFrame";
import type { JsonValue } from "../../api/types";
import { PartEntry } from "./NumberFieldRow";

const POINTS = { gridTemplateColumns: "auto auto 1fr", gap: "0.2rem 0.5rem", alignItems: "center" };

/** Velocity and force: unit, and what is accepted. */
const PARTS = [
  { part: 0, name: "velocity", unit: "m/s", farthest: 20 },
  { part: 1, name: "force", unit: "N", farthest: 1_000_000 },
] as const;

export function DamperCurveRow({ field }: { readonly field: DataField }) {
  const id = useId();
  const [edit, leaf] = [useEdit(), useLeaf(field)];
  const damping = useFromScenario((scenario) =>
    numberAt(scenario, field.pointer.replace("damper_curve", "damping") as typeof field.pointer, 0),
  );
  // Axes stay as they are while a point is dragged.
  const settled = useLab(({ history }) => (history ? curveIn(valueAt(history.present, field)) : null));
  const points = curveIn(leaf.value);
  const { readOnly } = leaf;
  const reach = (part: 0 | 1) =>
    1.15 * Math.max(0.1, ...(settled ?? points ?? []).map((point) => Math.abs(point[part])));
  const ranges = [
    [-reach(0), reach(0)],
    [-reach(1), reach(1)],
  ] as const;
  const commit = (next: readonly DamperPoint[] | null) => leaf.commit(next);
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      paperText="none"
      aside={
        <Switch
          id={id}
          size="xs"
          checked={points !== null}
          disabled={readOnly}
          onChange={(event) => commit(event.currentTarget.checked ? linearCurve(damping) : null)}
        />
      }
    >
      {points && (
        <>
          <EditableCurves
            label={`${field.title}: force in N over velocity in m/s`}
            height={150}
            curves={[{ name: "", ...drawnCurve(points, reach(0)) }]}
            selected={0}
            points={points.map(([x, y], index) => ({
              name: `Point ${index + 1}`,
              text: `${formatExact(x, "m/s")}, ${formatExact(y, "N")}`,
              x,
              y,
            }))}
            onMove={(point, x, y) => leaf.drag(movedPoint(points, point, x, y))}
            onRelease={leaf.release}
            xRange={ranges[0]}
            yRange={ranges[1]}
            readOnly={readOnly}
          />
          <Box display="grid" mb="0.4rem" fz="xs" c="dimmed" style={POINTS}>
            <span>velocity, rebound +</span>
            <span>force</span>
            <span />
            {points.map((point, index) => (
              <Fragment key={index}>
                {PARTS.map(({ part, name, unit, farthest }) => (
                  <PartEntry
                    key={name}
                    unlabelled
                    name={`Point ${index + 1}, ${name}`}
                    pointer={child(child(field.pointer, index), part)}
                    range={ranges[part]}
                    value={point[part]}
                    error={leaf.error}
                    written={(value) => setAt(edit.newest(), child(child(field.pointer, index), part), value)}
                    {...{ unit, farthest }}
                  />
                ))}
                <ActionIcon
                  size={24}
                  variant="subtle"
                  color="gray"
                  disabled={readOnly || points.length <= 2}
                  aria-label={`Remove point ${index + 1}`}
                  onClick={() => commit(points.toSpliced(index, 1))}
                >
                  <Icon name="X" size={15} />
                </ActionIcon>
              </Fragment>
            ))}
          </Box>
          {!readOnly && (
            <Button size="compact-xs" disabled={points.length >= 20} onClick={() => commit(withPoint(points))}>
              Add a point
            </Button>
          )}
        </>
      )}
    </FieldFrame>
  );
}

/** Velocity [m/s], rebound positive, and force [N]. */
type DamperPoint = readonly [number, number];

/** What suppliers measure at. */
const VELOCITIES = [-1, -0.3, 0.3, 1];

/** The linear damper's force at a few velocities. */
export const linearCurve = (damping: number): readonly DamperPoint[] =>
  VELOCITIES.map((velocity) => [velocity, rounded(velocity * damping)]);

const curveIn = (value: JsonValue | undefined): readonly DamperPoint[] | null =>
  Array.isArray(value) ? (value as readonly DamperPoint[]) : null;

const withOrigin = (points: readonly DamperPoint[]): readonly DamperPoint[] =>
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
