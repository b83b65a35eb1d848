/** Data that files and scripts set, such as a rule base: whether it is the paper's, and a way back to it. */

import { Text } from "@mantine/core";
import classes from "./editor.module.css";
import { FieldFrame } from "./FieldFrame";
import type { DataField } from "../../scenario/schema";
import { useLeaf } from "./useLeaf";

export function DataRow({ field }: { readonly field: DataField }) {
  const leaf = useLeaf(field.pointer, field.standard);
  const name = `data-${field.pointer}`;
  return (
    <FieldFrame id={name} {...{ field, leaf }} standard="Table 1">
      <Text component="output" id={name} className={classes.note}>
        {leaf.changed ? "The scenario has its own." : "As in the paper."}
      </Text>
    </FieldFrame>
  );
}
