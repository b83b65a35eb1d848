/** The switches of the loop: what lies between the ECU and the car. */

import { NativeSelect, Text, TextInput } from "@mantine/core";
import { useId, useState } from "react";
import type { Scenario } from "../api/types";
import { Help, ResetButton } from "../editor/FieldFrame";
import { readTyped } from "../editor/limits";
import { getAt, sameValue, setAt, type Pointer } from "../editor/path";
import { fieldsOf, findMember, humanise, type ChoiceField, type Group, type NumberField } from "../editor/schema";
import { formatInput, prettyUnit } from "../units/format";
import classes from "./hil.module.css";

interface Props {
  readonly form: Group;
  readonly scenario: Scenario;
  /** The server's, by field. */
  readonly errors: Readonly<Record<Pointer, string>>;
  readonly onChange: (scenario: Scenario) => void;
}

export function HilForm({ form, scenario, errors, onChange }: Props) {
  const group = findMember(form, "/hil");
  if (!group) return null;
  return (
    <div className={classes.switches} role="group" aria-label="Between the ECU and the car">
      {fieldsOf(group).map((field) => {
        if (field.kind === "vector") return null;
        const change = (value: number | string) => onChange(setAt(scenario, field.pointer, value));
        const props = { scenario, error: errors[field.pointer], onChange: change };
        return field.kind === "number" ? <NumberSwitch key={field.pointer} field={field} {...props} /> : <ChoiceSwitch key={field.pointer} field={field} {...props} />;
      })}
    </div>
  );
}

interface SwitchProps<Field> {
  readonly field: Field;
  readonly scenario: Scenario;
  readonly error: string | undefined;
  readonly onChange: (value: number | string) => void;
}

function Label<Field extends NumberField | ChoiceField>({ id, field, scenario, onChange, standard }: SwitchProps<Field> & { readonly id: string; readonly standard: string }) {
  const changed = !sameValue(getAt(scenario, field.pointer), field.standard);
  return (
    <span className={classes.switchHead}>
      <label htmlFor={id} className={classes.switchLabel} data-changed={changed || undefined}>
        {field.title}
      </label>
      <Help id={id} title={field.title} text={field.description} />
      <ResetButton
        title={field.title}
        standard={standard}
        changed={changed}
        fixed={false}
        onReset={() => (typeof field.standard === "number" || typeof field.standard === "string" ? onChange(field.standard) : undefined)}
      />
    </span>
  );
}

function NumberSwitch(props: SwitchProps<NumberField>) {
  const { field, scenario, error, onChange } = props;
  const id = useId();
  const [draft, setDraft] = useState<string | null>(null);
  const [refused, setRefused] = useState<string | null>(null);
  const value = getAt(scenario, field.pointer);
  const unit = prettyUnit(field.unit);
  const finish = () => {
    if (draft === null) return;
    const reading = readTyped(field, draft);
    setRefused(reading.ok ? null : reading.message);
    if (!reading.ok) return;
    setDraft(null);
    if (reading.value !== value) onChange(reading.value);
  };
  const message = refused ?? error;
  return (
    <div className={classes.switch}>
      <Label {...props} id={id} standard={typeof field.standard === "number" ? formatInput(field.standard) : "–"} />
      <TextInput
        id={id}
        size="xs"
        inputMode="decimal"
        autoComplete="off"
        value={draft ?? (typeof value === "number" ? formatInput(value) : "")}
        error={message !== undefined}
        {...(message === undefined ? {} : { "aria-describedby": `${id}-error` })}
        {...(unit === "" ? {} : { rightSection: <span className={classes.unit}>{unit}</span> })}
        rightSectionPointerEvents="none"
        onChange={(event) => setDraft(event.currentTarget.value)}
        onFocus={(event) => event.currentTarget.select()}
        onBlur={finish}
        onKeyDown={(event) => {
          if (event.key === "Enter") finish();
          if (event.key === "Escape") {
            setDraft(null);
            setRefused(null);
          }
        }}
      />
      <Problem id={id} message={message} />
    </div>
  );
}

function ChoiceSwitch(props: SwitchProps<ChoiceField>) {
  const { field, scenario, error, onChange } = props;
  const id = useId();
  const value = getAt(scenario, field.pointer);
  return (
    <div className={classes.switch}>
      <Label {...props} id={id} standard={typeof field.standard === "string" ? humanise(field.standard) : "–"} />
      <NativeSelect
        id={id}
        size="xs"
        value={typeof value === "string" ? value : ""}
        error={error !== undefined}
        data={field.options.map((option) => ({ value: option, label: humanise(option) }))}
        onChange={(event) => onChange(event.currentTarget.value)}
      />
      <Problem id={id} message={error} />
    </div>
  );
}

function Problem({ id, message }: { readonly id: string; readonly message: string | undefined }) {
  return message === undefined ? null : (
    <Text id={`${id}-error`} className={classes.error ?? ""} role="alert">
      {message}
    </Text>
  );
}
