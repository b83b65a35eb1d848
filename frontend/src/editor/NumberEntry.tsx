/** The typed side of a number: keeps what somebody types until it is a value the field can take. */

import { TextInput } from "@mantine/core";
import { useState } from "react";
import { formatInput, prettyUnit } from "../units/format";
import classes from "./editor.module.css";
import { readTyped } from "./limits";
import type { NumberField } from "./schema";
import type { LeafState } from "./useLeaf";

interface Props {
  readonly id: string;
  readonly field: NumberField;
  readonly leaf: LeafState;
  readonly label?: string;
  readonly withUnit?: boolean;
  readonly disabled?: boolean;
}

export function NumberEntry({ id, field, leaf, label, withUnit = true, disabled = false }: Props) {
  const [draft, setDraft] = useState<string | null>(null);
  const shown = typeof leaf.value === "number" ? formatInput(leaf.value) : "";
  const unit = prettyUnit(field.unit);

  const finish = () => {
    if (draft === null) return;
    const reading = readTyped(field, draft);
    setDraft(null);
    if (reading.ok) leaf.commit(reading.value);
    else leaf.reject({ text: draft, message: reading.message });
  };

  return (
    <TextInput
      id={id}
      className={withUnit ? classes.entry : classes.cellEntry}
      classNames={{ input: classes.entryInput ?? "" }}
      size="xs"
      inputMode="decimal"
      autoComplete="off"
      spellCheck={false}
      value={draft ?? leaf.rejected?.text ?? shown}
      disabled={disabled || leaf.readOnly}
      error={leaf.error !== undefined}
      {...(label === undefined ? {} : { "aria-label": label })}
      {...(leaf.error === undefined ? {} : { "aria-describedby": `${id}-error` })}
      {...(withUnit && unit !== "" ? { rightSection: <span className={classes.unit}>{unit}</span>, rightSectionWidth: 52 } : {})}
      rightSectionPointerEvents="none"
      onChange={(event) => setDraft(event.currentTarget.value)}
      onFocus={(event) => event.currentTarget.select()}
      onBlur={finish}
      onKeyDown={(event) => {
        if (event.key === "Enter") finish();
        if (event.key === "Escape") {
          setDraft(null);
          leaf.accept();
        }
      }}
    />
  );
}
