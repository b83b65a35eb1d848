/** The typed side of a number: keeps what somebody types until it is a value the field can take; arrow keys step it. */

import { TextInput } from "@mantine/core";
import { useState } from "react";
import { prettyUnit } from "../../units/format";
import classes from "./editor.module.css";
import { parseTyped, stepped, typedText } from "../../scenario/limits";
import type { NumberField } from "../../scenario/schema";
import { useKeyRest } from "./useKeyRest";
import type { LeafState } from "./useLeaf";

/** Slider steps of an arrow key with Shift. */
const LARGE_STEP = 10;

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
  const shown = typeof leaf.value === "number" ? typedText(field, leaf.value) : "";
  const unit = prettyUnit(field.shown.unit);

  const rest = useKeyRest(leaf.release);

  const finish = () => {
    rest.flush();
    if (draft === null) return;
    const parsed = parseTyped(field, draft);
    setDraft(null);
    if (parsed.ok) leaf.commit(parsed.value);
    else leaf.reject({ text: draft, message: parsed.message });
  };

  const step = (steps: number) => {
    const parsed = draft === null ? null : parseTyped(field, draft);
    const from = parsed === null ? leaf.value : parsed.ok ? parsed.value : null;
    if (typeof from !== "number") return;
    setDraft(null);
    leaf.drag(stepped(field, from, steps));
    rest.begin();
  };

  return (
    <TextInput
      id={id}
      data-pointer={field.pointer}
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
      {...(withUnit && unit !== ""
        ? { rightSection: <span className={classes.unit}>{unit}</span>, rightSectionWidth: 52 }
        : {})}
      rightSectionPointerEvents="none"
      onChange={(event) => setDraft(event.currentTarget.value)}
      onFocus={(event) => event.currentTarget.select()}
      onBlur={finish}
      onKeyDown={(event) => {
        if (event.key === "Enter") finish();
        if (event.key === "ArrowUp" || event.key === "ArrowDown") {
          event.preventDefault();
          step((event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? LARGE_STEP : 1));
        }
        if (event.key === "Escape") {
          setDraft(null);
          leaf.accept();
        }
      }}
    />
  );
}
