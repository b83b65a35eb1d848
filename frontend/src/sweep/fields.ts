/** The scenario's fields as a sweep names them: `road.bump.height`, `mpc.stage_weights.cruise.0`. */

import type { Pointer } from "../editor/path";
import type { ChoiceField, Group, Member, NumberField } from "../editor/schema";

export interface SweepField {
  /** Dotted name. */
  readonly name: string;
  readonly title: string;
  /** The parts of the scenario it lies in, outermost first. */
  readonly section: string;
  readonly leaf: NumberField | ChoiceField;
}

export const dotted = (pointer: Pointer) => pointer.slice(1).replace(/\//g, ".");

export const pointerOf = (name: string): Pointer => `/${name.replace(/\./g, "/")}`;

export function sweepFields(form: Group): readonly SweepField[] {
  return form.members.flatMap((member) => below(member, []));
}

function below(member: Member, sections: readonly string[]): readonly SweepField[] {
  const section = sections.join(" › ") || "Scenario";
  switch (member.kind) {
    case "group":
      return member.members.flatMap((inner) => below(inner, [...sections, member.title]));
    case "vector":
      return member.items.map((leaf) => ({ name: dotted(leaf.pointer), title: `${member.title}: ${leaf.title}`, section, leaf }));
    case "text":
      return [];
    default:
      return [{ name: dotted(member.pointer), title: member.title, section, leaf: member }];
  }
}
