/** A number with its slider and its typed value; switched off where it may be null. */

import { Switch } from "@mantine/core";
import { useId } from "react";
import { formatExact } from "../units/format";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import { typicalValue } from "./limits";
import { NumberEntry } from "./NumberEntry";
import { NumberSlider } from "./NumberSlider";
import type { NumberField } from "./schema";
import { useLeaf } from "./useLeaf";

const OFF = "off";

export function NumberFieldRow({ field }: { readonly field: NumberField }) {
  const id = useId();
  const leaf = useLeaf(field.pointer, field.standard);
  const isOff = leaf.value === null;
  const standard = typeof field.standard === "number" ? formatExact(field.standard, field.unit) : OFF;
  return (
    <FieldFrame
      id={id}
      title={field.title}
      description={field.description}
      changed={leaf.changed}
      fixed={leaf.readOnly}
      standard={standard}
      error={leaf.error}
      onReset={() => leaf.commit(field.standard)}
      aside={
        <>
          {field.nullable && (
            <Switch
              size="xs"
              className={classes.toggle ?? ""}
              checked={!isOff}
              disabled={leaf.readOnly}
              aria-label={`${field.title}: limited`}
              onChange={(event) => leaf.commit(event.currentTarget.checked ? typicalValue(field) : null)}
            />
          )}
          {isOff ? <span className={classes.off}>{OFF}</span> : <NumberEntry id={id} field={field} leaf={leaf} />}
        </>
      }
    >
      {!isOff && <NumberSlider field={field} leaf={leaf} label={field.title} />}
    </FieldFrame>
  );
}
