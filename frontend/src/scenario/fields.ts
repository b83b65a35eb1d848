/** The scenario's fields as a sweep names them: `road.bump.height`, `mpc.stage_weights.cruise.0`. */

import type { JsonValue, Scenario } from "../api/types";
import { setAt, type Pointer } from "./path";
import type { ChoiceField, Group, Member, NumberField } from "./schema";
import type { FieldError } from "../api/problem";
import { leavesOf } from "./differences";

export interface SweepField {
  /** Dotted name. */
  readonly name: string;
  readonly title: string;
  /** The parts of the scenario it lies in, outermost first. */
  readonly section: string;
  readonly leaf: NumberField | ChoiceField;
}

/** A greater one is another road, not more of anything. */
export const SEED = "road.seed";

export const dotted = (pointer: Pointer) => pointer.slice(1).replace(/\//g, ".");

export const pointerOf = (name: string): Pointer => `/${name.replace(/\./g, "/")}`;

/** The scenario with other values, by dotted name. */
export const withFields = (scenario: Scenario, values: Readonly<Record<string, JsonValue>>): Scenario =>
  Object.entries(values).reduce((changed, [name, value]) => setAt(changed, pointerOf(name), value), scenario);

export function sweepFields(form: Group): readonly SweepField[] {
  return form.members.flatMap((member) => below(member, []));
}

function below(member: Member, sections: readonly string[]): readonly SweepField[] {
  const section = sections.join(" › ") || "Scenario";
  switch (member.kind) {
    case "group":
      return member.members.flatMap((inner) => below(inner, [...sections, member.title]));
    case "vector":
      return member.items.map((leaf) => ({
        name: dotted(leaf.pointer),
        title: `${member.title}: ${leaf.title}`,
        section,
        leaf,
      }));
    case "text":
    case "data":
      return [];
    default:
      return [{ name: dotted(member.pointer), title: member.title, section, leaf: member }];
  }
}

export interface ErrorsByField {
  /** By field of the form. */
  readonly fields: Readonly<Record<Pointer, string>>;
  /** What belongs to no field. */
  readonly general: readonly string[];
}

const SCENARIO = "/scenario";

/** Finds the field for a pointer into the request: itself, the nearest one above it, or the first one below it. */
export function fieldFor(root: Group, pointer: string): Pointer | null {
  if (!pointer.startsWith(`${SCENARIO}/`)) return null;
  const inside = pointer.slice(SCENARIO.length);
  const pointers = leavesOf(root).map((leaf) => leaf.pointer);
  const above = pointers.find((candidate) => inside === candidate || inside.startsWith(`${candidate}/`));
  return above ?? pointers.find((candidate) => candidate.startsWith(`${inside}/`)) ?? null;
}

export function errorsByField(root: Group, errors: readonly FieldError[], fallback: string): ErrorsByField {
  const fields: Record<Pointer, string> = {};
  const general: string[] = [];
  for (const { pointer, message } of errors) {
    const field = fieldFor(root, pointer);
    if (field === null) general.push(message);
    else fields[field] = fields[field] === undefined ? message : `${fields[field]}. ${message}`;
  }
  if (errors.length === 0) general.push(fallback);
  return { fields, general };
}
