/** A number with its slider and its typed value; switched off where it may be null. */

import { Box, Switch } from "@mantine/core";
import { useId } from "react";
import { FieldFrame } from "./FieldFrame";
import { typicalValue, valueText } from "../../scenario/limits";
import { NumberEntry } from "./NumberEntry";
import { NumberSlider } from "./NumberSlider";
import type { NumberField } from "../../scenario/schema";
import type { LeafState } from "./useLeaf";

const OFF = "off";

interface Props {
  readonly field: NumberField;
  readonly leaf: LeafState;
  readonly withSlider?: boolean;
}

export function NumberFieldRow({ field, leaf, withSlider = true }: Props) {
  const id = useId();
  const isOff = leaf.value === null;
  const standard = typeof field.standard === "number" ? valueText(field, field.standard) : OFF;
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      standard={standard}
      aside={
        <>
          {field.nullable && (
            <Switch
              size="xs"
              flex="none"
              checked={!isOff}
              disabled={leaf.readOnly}
              aria-label={`${field.title}: limited`}
              onChange={(event) => leaf.commit(event.currentTarget.checked ? typicalValue(field) : null)}
            />
          )}
          {isOff ? (
            <Box component="span" w={118} pr={10} fz="xs" lh="30px" ta="right" c="dimmed">
              {OFF}
            </Box>
          ) : (
            <NumberEntry id={id} field={field} leaf={leaf} />
          )}
        </>
      }
    >
      {withSlider && !isOff && <NumberSlider field={field} leaf={leaf} label={field.title} />}
    </FieldFrame>
  );
}
