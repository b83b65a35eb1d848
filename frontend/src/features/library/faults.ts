/** Why the server refused a file's values, by the form's names and in its units. */

import type { FieldError } from "../../api/problem";
import type { JsonValue, Scenario } from "../../api/types";
import { namedLeaves, type Leaf } from "../../scenario/differences";
import { limitText, valueText } from "../../scenario/limits";
import { getAt, type Pointer } from "../../scenario/path";
import { findMember, optionTitle, type Form, type NumberField } from "../../scenario/schema";

/** A sentence for each error; what the form cannot explain stays as the server says it. */
export function faultsOf(form: Form, scenario: Scenario, errors: readonly FieldError[]): readonly string[] {
  const leaves = namedLeaves(form);
  return errors.map(({ pointer, message }) => {
    const place = pointer.replace(/^\/scenario(?=\/|$)/, "") as Pointer | "";
    const found = leaves.find(({ leaf }) => leaf.pointer === place);
    if (found) return `${found.name}: ${wrong(found.leaf, getAt(scenario, found.leaf.pointer)) ?? message}`;
    const member = place === "" ? undefined : findMember(form, place);
    if (!member) return place === "" ? message : `${place.slice(1).replace(/\//g, ".")}: ${message}`;
    const { title } = member;
    if (member.kind === "vector") return `${title}: Needs ${member.items.length} numbers`;
    return `${title}: ${isGroup(getAt(scenario, member.pointer)) ? message : "Needs its fields by name, in braces"}`;
  });
}

const isGroup = (value: JsonValue | undefined) => typeof value === "object" && value !== null && !Array.isArray(value);

/** `null` where the value is right by itself. */
function wrong(leaf: Leaf, value: JsonValue | undefined): string | null {
  if (leaf.kind === "number") return wrongNumber(leaf, value);
  if (leaf.kind === "text")
    return typeof value === "string" && /^\w[\w-]{21}$/.test(value) ? null : "Needs the id of a measured road";
  if (leaf.kind === "data") return null;
  if (leaf.onOff) return typeof value === "boolean" ? null : "Must be true or false";
  return leaf.options.includes(value as string)
    ? null
    : `Must be one of ${leaf.options.map((option) => `${optionTitle(option)} (${option})`).join(", ")}`;
}

function wrongNumber(field: NumberField, value: JsonValue | undefined): string | null {
  if (value === null && field.nullable) return null;
  if (typeof value !== "number") return field.unit === "1" ? "Must be a number" : `Must be a number, in ${field.unit}`;
  if (field.integer && !Number.isInteger(value)) return "Must be a whole number";
  const low = field.exclusiveMinimum ? value <= field.minimum : value < field.minimum;
  return low || value > field.maximum ? `${limitText(field)}; the file has ${valueText(field, value)}` : null;
}
