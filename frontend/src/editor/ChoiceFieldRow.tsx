/** A choice between names. */

import { NativeSelect } from "@mantine/core";
import { useId } from "react";
import type { JsonValue } from "../api/types";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import { humanise, type ChoiceField } from "./schema";
import type { LeafState } from "./useLeaf";

const asText = (value: JsonValue | undefined) => (typeof value === "string" ? value : "");

export function ChoiceFieldRow({ field, leaf }: { readonly field: ChoiceField; readonly leaf: LeafState }) {
  const id = useId();
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      standard={humanise(asText(field.standard))}
      aside={
        <NativeSelect
          id={id}
          size="xs"
          className={classes.choice ?? ""}
          value={asText(leaf.value)}
          disabled={leaf.readOnly}
          error={leaf.error !== undefined}
          data={field.options.map((value) => ({ value, label: humanise(value) }))}
          onChange={(event) => leaf.commit(event.currentTarget.value)}
        />
      }
    />
  );
}
