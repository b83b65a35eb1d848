/** The settings of the loop: what lies between the ECU and the car. */

import { useState } from "react";
import type { JsonValue, Scenario } from "../../api/types";
import { ChoiceFieldRow } from "../../features/editor/FieldFrame";
import { NumberFieldRow } from "../../features/editor/NumberFieldRow";
import { getAt, sameValue, setAt, type Pointer } from "../../scenario/path";
import { fieldsOf, findMember, type ChoiceField, type Group, type NumberField } from "../../scenario/schema";
import type { LeafState } from "../../features/editor/useLeaf";
import type { InvalidInput } from "../../lab/labState";
import classes from "./ecu.module.css";

interface Props {
  readonly form: Group;
  readonly scenario: Scenario;
  /** The server's, by field. */
  readonly errors: Readonly<Record<Pointer, string>>;
  readonly onChange: (scenario: Scenario) => void;
}

export function EcuForm({ form, ...props }: Props) {
  const group = findMember(form, "/hil");
  if (!group) return null;
  return (
    <div className={classes.settings} role="group" aria-label="Between the ECU and the car">
      {fieldsOf(group).map(
        (field) =>
          (field.kind === "number" || field.kind === "choice") && (
            <Setting key={field.pointer} field={field} {...props} />
          ),
      )}
    </div>
  );
}

function Setting({
  field,
  scenario,
  errors,
  onChange,
}: Omit<Props, "form"> & { readonly field: NumberField | ChoiceField }) {
  const [rejected, setRejected] = useState<InvalidInput | undefined>();
  const value = getAt(scenario, field.pointer);
  const commit = (next: JsonValue) => {
    setRejected(undefined);
    if (!sameValue(value, next)) onChange(setAt(scenario, field.pointer, next));
  };
  const leaf: LeafState = {
    value,
    readOnly: false,
    changed: !sameValue(value, field.paperValue),
    rejected,
    error: rejected?.message ?? errors[field.pointer],
    drag: commit,
    release: () => undefined,
    commit,
    reject: setRejected,
    accept: () => setRejected(undefined),
  };
  return field.kind === "number" ? (
    <NumberFieldRow {...{ field, leaf }} withSlider={false} />
  ) : (
    <ChoiceFieldRow {...{ field, leaf }} />
  );
}
