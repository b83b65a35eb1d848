/** What differs from the paper. */

import type { Scenario } from "../api/types";
import { getAt, sameValue, setAt, type Pointer } from "./path";
import { fieldsOf, type Field, type Member, type NumberField, type ChoiceField, type TextField } from "./schema";

/** A field somebody changes by itself: the entries of a vector count one by one. */
export type Leaf = NumberField | ChoiceField | TextField;

export function leavesOf(member: Member): readonly Leaf[] {
  return fieldsOf(member).flatMap((field: Field): readonly Leaf[] => (field.kind === "vector" ? field.items : [field]));
}

export function isChanged(scenario: Scenario, leaf: Leaf): boolean {
  return !sameValue(getAt(scenario, leaf.pointer), leaf.standard);
}

export function changedPointers(scenario: Scenario, member: Member): readonly Pointer[] {
  return leavesOf(member)
    .filter((leaf) => isChanged(scenario, leaf))
    .map((leaf) => leaf.pointer);
}

export function resetMember(scenario: Scenario, member: Member): Scenario {
  return leavesOf(member).reduce((result, leaf) => setAt(result, leaf.pointer, leaf.standard), scenario);
}

/** The paper's scenario as the schema states it. */
export function standardScenario(root: Member): Scenario {
  return fieldsOf(root).reduce<Scenario>((result, field) => setAt(result, field.pointer, field.standard), {});
}
