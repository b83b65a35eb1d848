/** Hard limits of typed values, slider steps and slider scales. */

import { spansDecades, stepBelow } from "../lib/steps";
import { formatExact, formatInput } from "../units/format";
import { parseQuantity, type Quantity } from "../units/quantity";
import type { NumberField } from "./schema";

/** What is wrong with a range whose ends are the wrong way round. */
export const NO_RANGE = "From has to be less than To";

/** Reads and checks a typed value against the field's own limits; the server checks what involves other fields. */
export function parseTyped(field: NumberField, text: string): Quantity {
  if (text.trim() === "") return { ok: false, message: "Needs a value" };
  const typed = parseQuantity(text, field.shown.unit);
  if (!typed.ok) return typed;
  const value = rounded(typed.value / field.shown.scale);
  if (field.integer && !Number.isInteger(value)) return { ok: false, message: "Must be a whole number" };
  const low = field.exclusiveMinimum ? value <= field.minimum : value < field.minimum;
  if (low || value > field.maximum) return { ok: false, message: limitText(field) };
  return { ok: true, value };
}

export function limitText(field: NumberField): string {
  const low = formatExact(inShownUnit(field, field.minimum), "1");
  const high = valueText(field, field.maximum);
  if (field.exclusiveMinimum) return `Must be above ${low} and at most ${high}`;
  return `Must be from ${low} to ${high}`;
}

// 0.07 m are 7 cm, not 7.000000000000001.
const rounded = (value: number) => Number(value.toPrecision(12));

/** The number that stands in a field for a value of it. */
export const inShownUnit = ({ shown }: NumberField, value: number) => rounded(value * shown.scale);

/** A field's value as it would be typed, without its unit. */
export const typedText = (field: NumberField, value: number) => formatInput(inShownUnit(field, value));

/** A field's value with all its digits and its unit. */
export const valueText = (field: NumberField, value: number) =>
  formatExact(inShownUnit(field, value), field.shown.unit);

/**
 * A slider's own scale. It counts steps, so that it moves by 1 whatever the field's size; where the soft range spans
 * decades, steps are equal ratios.
 */
export interface SliderScale {
  readonly minimum: number;
  readonly maximum: number;
  readonly toSlider: (value: number) => number;
  readonly fromSlider: (position: number) => number;
}

const STEPS_PER_DECADE = 20;

export function sliderScale(field: NumberField): SliderScale {
  const [low, high] = field.soft;
  if (spansDecades(low, high)) {
    const toSlider = (value: number) => Math.log10(Math.max(value, low)) * STEPS_PER_DECADE;
    const fromSlider = (position: number) => Number((10 ** (position / STEPS_PER_DECADE)).toPrecision(2));
    return { minimum: toSlider(low), maximum: toSlider(high), toSlider, fromSlider };
  }
  const fine = stepBelow((high - low) / 100);
  const step = field.integer ? Math.max(1, fine) : fine;
  return {
    minimum: low / step,
    maximum: high / step,
    toSlider: (value) => value / step,
    // Multiples of the step, without the dust of binary fractions.
    fromSlider: (position) => Number((Math.round(position) * step).toPrecision(10)),
  };
}

/** The value so many slider steps further, on the slider's own marks, within the hard limits. */
export function stepped(field: NumberField, value: number, steps: number): number {
  const scale = sliderScale(field);
  const next = Math.min(field.maximum, Math.max(field.minimum, scale.fromSlider(scale.toSlider(value) + steps)));
  return field.exclusiveMinimum && next <= field.minimum ? value : next;
}

/** What a nullable field starts with when it is switched on: the middle of its soft range, by ratio, rounded. */
export function typicalValue(field: NumberField): number {
  const [low, high] = field.soft;
  const middle = low > 0 ? Math.sqrt(low * high) : (low + high) / 2;
  return Number(middle.toPrecision(1));
}
