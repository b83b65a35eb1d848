/** A choice between names. */

import { NativeSelect } from "@mantine/core";
import { useId } from "react";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import { optionOf, optionTitle, optionValue, type ChoiceField } from "../../scenario/schema";
import type { LeafState } from "./useLeaf";

export function ChoiceFieldRow({ field, leaf }: { readonly field: ChoiceField; readonly leaf: LeafState }) {
  const id = useId();
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      standard={optionTitle(optionOf(field.standard))}
      aside={
        <NativeSelect
          id={id}
          size="xs"
          className={classes.choice ?? ""}
          value={optionOf(leaf.value)}
          disabled={leaf.readOnly}
          error={leaf.error !== undefined}
          data={field.options.map((value) => ({ value, label: optionTitle(value) }))}
          onChange={(event) => leaf.commit(optionValue(field, event.currentTarget.value))}
        />
      }
    />
  );
}
