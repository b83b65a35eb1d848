/** A sweep's fields and their values in the units the form shows them in. */

import type { Batch } from "../../api/types";
import { inShownUnit } from "../../scenario/limits";
import type { Group, NumberField } from "../../scenario/schema";
import { sweepFields } from "../../scenario/fields";
import type { Columns } from "../../features/sweep/table";

type Fields = Batch["fields"];

function leavesByName(fields: Fields, form: Group): ReadonlyMap<string, NumberField> {
  const names = new Set(fields.map(({ name }) => name));
  return new Map(
    sweepFields(form).flatMap(({ name, leaf }) =>
      leaf.kind === "number" && names.has(name) ? [[name, leaf] as const] : [],
    ),
  );
}

export function shownFields(fields: Fields, form: Group): Fields {
  const leaves = leavesByName(fields, form);
  return fields.map((field) => ({ ...field, unit: leaves.get(field.name)?.shown.unit ?? field.unit }));
}

export function shownColumns(columns: Columns, fields: Fields, form: Group): Columns {
  const scaled = [...leavesByName(fields, form)].flatMap(([name, leaf]) => {
    const values = leaf.shown.scale === 1 ? undefined : columns[name];
    return values
      ? [[name, values.map((value) => (typeof value === "number" ? inShownUnit(leaf, value) : value))] as const]
      : [];
  });
  return scaled.length === 0 ? columns : { ...columns, ...Object.fromEntries(scaled) };
}
