/** A number with its slider and its typed value; switched off where it may be null. */

import { Box, Switch, Input } from "@mantine/core";
import { useId, useState, useRef, type CSSProperties } from "react";
import { FieldFrame, FieldError, type LeafState, useValue } from "./FieldFrame";
import {
  typicalValue,
  valueText,
  parseTyped,
  stepped,
  typedText,
  inShownUnit,
  sliderScale,
} from "../../scenario/limits";
import type { NumberField } from "../../scenario/schema";
import { useReleaseAfterKeys } from "../../lib/timer";
import { formatWithUnit } from "../../units/format";
import { Entry } from "../../ui/Entry";
import classes from "./editor.module.css";
import type { Scenario } from "../../api/types";
import type { Pointer } from "../../scenario/path";
import { shownIn } from "../../units/quantity";

const OFF = "off";

interface Props {
  readonly field: NumberField;
  readonly leaf: LeafState;
  readonly withSlider?: boolean;
}

export function NumberFieldRow({ field, leaf, withSlider = true }: Props) {
  const id = useId();
  const isOff = leaf.value === null;
  const paperText = typeof field.paperValue === "number" ? valueText(field, field.paperValue) : OFF;
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      paperText={paperText}
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

/** Slider steps of an arrow key with Shift. */
const LARGE_STEP = 10;

interface NumberEntryProps {
  readonly id: string;
  readonly field: NumberField;
  readonly leaf: LeafState;
  readonly label?: string;
  readonly withUnit?: boolean;
  readonly disabled?: boolean;
}

/** The typed side of a number: keeps what somebody types until it is a value the field can take; arrow keys step it. */
export function NumberEntry({ id, field, leaf, label, withUnit = true, disabled = false }: NumberEntryProps) {
  const [draft, setDraft] = useState<string | null>(null);
  const shown = typeof leaf.value === "number" ? typedText(field, leaf.value) : "";

  const releaseSoon = useReleaseAfterKeys(leaf.release);

  const finish = () => {
    releaseSoon.flush();
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
    releaseSoon();
  };

  return (
    <Entry
      id={id}
      data-pointer={field.pointer}
      unit={withUnit ? field.shown.unit : "1"}
      {...(withUnit && { w: 118, flex: "none" })}
      styles={{
        input: withUnit ? { paddingRight: 54, textAlign: "right" } : { textAlign: "center" },
        section: { justifyContent: "flex-start" },
      }}
      autoComplete="off"
      spellCheck={false}
      value={draft ?? leaf.rejected?.text ?? shown}
      disabled={disabled || leaf.readOnly}
      error={leaf.error !== undefined}
      {...(label === undefined ? {} : { "aria-label": label })}
      {...(leaf.error === undefined ? {} : { "aria-describedby": `${id}-error` })}
      onType={setDraft}
      onFocus={(event) => event.currentTarget.select()}
      onBlur={finish}
      onKeyDown={(event) => {
        if (event.key === "Enter") finish();
        if (event.key === "ArrowUp" || event.key === "ArrowDown") {
          event.preventDefault();
          step((event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? LARGE_STEP : 1));
        }
        if (event.key === "Escape") {
          if (draft !== null || leaf.rejected) event.preventDefault(); // it closes nothing else
          setDraft(null);
          leaf.clearInvalid();
        }
      }}
    />
  );
}

interface NumberSliderProps {
  readonly field: NumberField;
  readonly leaf: LeafState;
  readonly label: string;
}

/** The dragged side of a number: live while it moves, exact once it rests. */
export function NumberSlider({ field, leaf, label }: NumberSliderProps) {
  const scale = sliderScale(field);
  const isPressed = useRef(false);
  const hasMoved = useRef(false);
  const releaseSoon = useReleaseAfterKeys(leaf.release);

  const clamp = (value: number) => Math.min(scale.maximum, Math.max(scale.minimum, scale.toSlider(value)));
  const value = typeof leaf.value === "number" ? clamp(leaf.value) : scale.minimum;
  const paperPlace = typeof field.paperValue === "number" ? scale.toSlider(field.paperValue) : null;
  const marked = paperPlace !== null && paperPlace >= scale.minimum && paperPlace <= scale.maximum;
  const spoken =
    typeof leaf.value === "number" ? formatWithUnit(inShownUnit(field, leaf.value), field.shown.unit, 4) : "";
  const part = (position: number) => (position - scale.minimum) / (scale.maximum - scale.minimum);
  const [from, to] = [marked ? paperPlace : scale.minimum, value].map(part).sort((one, other) => one - other);
  const release = () => {
    if (!isPressed.current) return;
    isPressed.current = false;
    if (!hasMoved.current) return;
    releaseSoon.cancel();
    leaf.release();
  };

  return (
    <input
      type="range"
      className={classes.slider}
      style={{ "--from": from, "--to": to, "--paper": marked ? part(paperPlace) : -1 } as CSSProperties}
      min={scale.minimum}
      max={scale.maximum}
      value={value}
      disabled={leaf.readOnly}
      aria-label={label}
      aria-valuetext={spoken}
      onChange={(event) => {
        const next = scale.fromSlider(event.currentTarget.valueAsNumber);
        if (next !== leaf.value) leaf.drag(next);
        hasMoved.current = true;
        if (!isPressed.current) releaseSoon();
      }}
      onPointerDown={({ button }) => {
        isPressed.current = button === 0 && !leaf.readOnly;
        hasMoved.current = false;
      }}
      onPointerUp={release}
      onPointerCancel={release}
      onLostPointerCapture={release}
    />
  );
}

interface PartEntryProps {
  readonly name: string;
  /** In a table, whose heads say what it is. */
  readonly unlabelled?: boolean;
  readonly pointer: Pointer;
  readonly unit: string;
  /** What its arrow keys step in a hundredth of. */
  readonly range: readonly [number, number];
  readonly farthest: number;
  readonly value: number | undefined;
  readonly error: string | undefined;
  readonly written: (value: number) => Scenario;
}

/** One of several numbers that are one value; what the value is refused for is said below all of them. */
export function PartEntry({
  name,
  unlabelled = false,
  pointer,
  unit,
  range,
  farthest,
  value,
  error,
  written,
}: PartEntryProps) {
  const id = useId();
  const leaf = useValue(pointer, value, (_, next) => written(Number(next)));
  const field = {
    kind: "number",
    pointer,
    title: name,
    description: "",
    paperValue: null,
    integer: false,
    nullable: false,
    unit,
    shown: shownIn(unit, unit),
    minimum: -farthest,
    maximum: farthest,
    exclusiveMinimum: false,
    soft: range,
  } as const;
  return (
    <div>
      {!unlabelled && <Input.Label htmlFor={id}>{name}</Input.Label>}
      <NumberEntry
        {...{ id, field }}
        leaf={{ ...leaf, error: leaf.error ?? error }}
        {...(unlabelled ? { label: name } : {})}
      />
      <FieldError id={id} error={leaf.rejected?.message} />
    </div>
  );
}
