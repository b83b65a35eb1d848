/** A choice between names. */

import { NativeSelect } from "@mantine/core";
import { useId } from "react";
import type { JsonValue } from "../api/types";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import { humanise, type ChoiceField } from "./schema";
import { useLeaf } from "./useLeaf";

const asText = (value: JsonValue | undefined) => (typeof value === "string" ? value : "");

export function ChoiceFieldRow({ field }: { readonly field: ChoiceField }) {
  const id = useId();
  const leaf = useLeaf(field.pointer, field.standard);
  return (
    <FieldFrame
      id={id}
      title={field.title}
      description={field.description}
      changed={leaf.changed}
      fixed={leaf.readOnly}
      standard={humanise(asText(field.standard))}
      error={leaf.error}
      onReset={() => leaf.commit(field.standard)}
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
