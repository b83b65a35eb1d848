/** A number that is a part of a value which the schema has no numbers of: a corner of a set, a point of a curve. */

import { Input } from "@mantine/core";
import { useId } from "react";
import type { Scenario } from "../../api/types";
import type { Pointer } from "../../scenario/path";
import { shownIn } from "../../units/quantity";
import { FieldError } from "./FieldFrame";
import { NumberEntry } from "./NumberFieldRow";
import { useValue } from "./useLeaf";

interface Props {
  readonly name: string;
  /** In a table, whose heads say what it is. */
  readonly unlabelled?: boolean;
  readonly pointer: Pointer;
  readonly unit: string;
  /** What its arrow keys step in a hundredth of. */
  readonly range: readonly [number, number];
  readonly farthest: number;
  readonly value: number | undefined;
  readonly error: string | undefined;
  readonly written: (value: number) => Scenario;
}

/** One of several numbers that are one value; what the value is refused for is said below all of them. */
export function PartEntry({ name, unlabelled = false, pointer, unit, range, farthest, value, error, written }: Props) {
  const id = useId();
  const leaf = useValue(pointer, value, (_, next) => written(Number(next)));
  const field = {
    kind: "number",
    pointer,
    title: name,
    description: "",
    paperValue: null,
    integer: false,
    nullable: false,
    unit,
    shown: shownIn(unit, unit),
    minimum: -farthest,
    maximum: farthest,
    exclusiveMinimum: false,
    soft: range,
  } as const;
  return (
    <div>
      {!unlabelled && <Input.Label htmlFor={id}>{name}</Input.Label>}
      <NumberEntry
        {...{ id, field }}
        leaf={{ ...leaf, error: leaf.error ?? error }}
        {...(unlabelled ? { label: name } : {})}
      />
      <FieldError id={id} error={leaf.rejected?.message} />
    </div>
  );
}
