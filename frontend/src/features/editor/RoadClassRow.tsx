/** The road's roughness: a class of ISO 8608 by its letter, its number always beside it. */

import { SegmentedControl, Text } from "@mantine/core";
import { useId } from "react";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import { NumberEntry } from "./NumberEntry";
import { ROAD_CLASSES, exactClass, nearestClass } from "../../scenario/roadClass";
import type { NumberField } from "../../scenario/schema";
import type { LeafState } from "./useLeaf";

const SMOOTH = "smooth";

function describe(roughness: number): string {
  if (roughness === 0) return "Smooth road";
  const exact = exactClass(roughness);
  const name = exact ? `Class ${exact.letter}` : `Within class ${nearestClass(roughness)?.letter ?? ""}`;
  return `${name} · Gd = ${inMillionths(roughness)}`;
}

/** Gd is written as so many 10⁻⁶ m³ in the standard's own tables. */
function inMillionths(roughness: number): string {
  return `${Number((roughness * 1e6).toPrecision(6))}×10⁻⁶ m³`;
}

export function RoadClassRow({ field, leaf }: { readonly field: NumberField; readonly leaf: LeafState }) {
  const id = useId();
  const roughness = typeof leaf.value === "number" ? leaf.value : 0;
  const roadClass = roughness === 0 ? SMOOTH : (exactClass(roughness)?.letter ?? "");
  const options = [
    { value: SMOOTH, label: "0" },
    ...ROAD_CLASSES.map(({ letter }) => ({ value: letter, label: letter })),
  ];
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      standard={typeof field.standard === "number" ? inMillionths(field.standard) : ""}
      aside={<NumberEntry id={id} field={field} leaf={leaf} />}
    >
      <SegmentedControl
        fullWidth
        size="xs"
        mt={4}
        aria-label="Road class (ISO 8608)"
        value={roadClass}
        disabled={leaf.readOnly}
        data={options}
        onChange={(value) => leaf.commit(ROAD_CLASSES.find(({ letter }) => letter === value)?.roughness ?? 0)}
      />
      <Text className={classes.note}>{describe(roughness)}</Text>
    </FieldFrame>
  );
}
