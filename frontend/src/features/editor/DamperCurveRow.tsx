/** A damper as its supplier gives it: its force at a few velocities, drawn; points are dragged, or typed. */

import { ActionIcon, Button, Switch } from "@mantine/core";
import { Fragment, useId } from "react";
import { useEdit, useFromScenario, useLab } from "../../lab/context";
import { EditableCurves } from "../../plots/EditableCurves";
import { valueAt } from "../../scenario/differences";
import { child, numberAt, setAt } from "../../scenario/path";
import type { DataField } from "../../scenario/schema";
import { IconX } from "../../ui/icons";
import { formatExact } from "../../units/format";
import { curveIn, drawnCurve, linearCurve, movedPoint, withPoint, type DamperPoint } from "./damperCurve";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import { PartEntry } from "./PartEntry";
import { useLeaf } from "./useLeaf";

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
      standard="none"
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
          <div className={classes.points}>
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
                  <IconX size={15} />
                </ActionIcon>
              </Fragment>
            ))}
          </div>
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
