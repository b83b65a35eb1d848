/** What differs from the paper, and between two scenarios. */

import type { JsonValue, Scenario } from "../api/types";
import { formatExact, prettyUnit } from "../units/format";
import { roadName } from "./library";
import { inShownUnit } from "./limits";
import { getAt, sameValue, setAt, type Pointer } from "./path";
import {
  fieldsOf,
  optionOf,
  optionTitle,
  type Field,
  type Member,
  type NumberField,
  type ChoiceField,
  type DataField,
  type TextField,
} from "./schema";

/** A field somebody changes by itself: the entries of a vector count one by one. */
export type Leaf = NumberField | ChoiceField | TextField | DataField;

export function leavesOf(member: Member): readonly Leaf[] {
  return fieldsOf(member).flatMap((field: Field): readonly Leaf[] => (field.kind === "vector" ? field.items : [field]));
}

/** A field's value: an option of a controller of one's own that a scenario lacks has its default. */
export function valueAt(scenario: Scenario, { pointer, paperValue }: Pick<Leaf, "pointer" | "paperValue">) {
  const value = getAt(scenario, pointer);
  return value === undefined && pointer.startsWith(OWN) ? paperValue : value;
}

export function isChanged(scenario: Scenario, leaf: Leaf): boolean {
  return !sameValue(valueAt(scenario, leaf), leaf.paperValue);
}

export function changedPointers(scenario: Scenario, member: Member): readonly Pointer[] {
  return leavesOf(member)
    .filter((leaf) => isChanged(scenario, leaf))
    .map((leaf) => leaf.pointer);
}

export function resetMember(scenario: Scenario, member: Member): Scenario {
  return leavesOf(member).reduce((result, leaf) => setAt(result, leaf.pointer, leaf.paperValue), scenario);
}

/** A scenario with the paper's value for each field it leaves out, and without what is no field. */
export function completed(root: Member, scenario: Scenario): Scenario {
  return fieldsOf(root).reduce<Scenario>((result, { pointer, paperValue }) => {
    const value = getAt(scenario, pointer);
    return setAt(result, pointer, value === undefined ? paperValue : value);
  }, {});
}

/** The paper's scenario as the schema states it. */
export const paperScenarioOf = (root: Member): Scenario => completed(root, {});

/** A field that two scenarios give different values: `Bump height`, `10 → 12 cm`. */
export interface FieldChange {
  readonly pointer: Pointer;
  readonly name: string;
  readonly change: string;
  /** The second scenario's alone: `12 cm`. */
  readonly value: string;
}

const lowered = (title: string) => (/^.[a-z]/.test(title) ? title.charAt(0).toLowerCase() + title.slice(1) : title);

/** The group's title before the field's, where that does not say it itself: `Bump height`, but `Target speed`. */
function named(group: string, title: string): string {
  return group === "" || title.toLowerCase().includes(group.toLowerCase()) ? title : `${group} ${lowered(title)}`;
}

function shown(value: JsonValue | undefined, leaf: Leaf): string {
  if (value === null || value === undefined || value === "") return "none";
  if (leaf.kind === "data") return "own";
  if (leaf.kind === "choice") return optionTitle(optionOf(value)).toLowerCase();
  return typeof value === "number" && leaf.kind === "number"
    ? formatExact(inShownUnit(leaf, value), "1")
    : typeof value === "string"
      ? roadName(value)
      : JSON.stringify(value);
}

/** Every field with a name that says on its own which one it is: `Bump height`. */
export function namedLeaves(form: Member, group = ""): readonly { readonly leaf: Leaf; readonly name: string }[] {
  if (form.kind === "group")
    return form.members.flatMap((member) => namedLeaves(member, form.pointer === "/" ? "" : form.title));
  const name = named(group, form.title);
  return leavesOf(form).map((leaf) => ({
    leaf,
    name: form.kind === "vector" ? `${name}, ${lowered(leaf.title)}` : name,
  }));
}

/** What two scenarios differ in, in the form's order, by the form's names and units. */
export function changedFields(form: Member, from: Scenario, to: Scenario): readonly FieldChange[] {
  return namedLeaves(form).flatMap(({ leaf, name }): readonly FieldChange[] => {
    const [one, other] = [valueAt(from, leaf), valueAt(to, leaf)];
    if (sameValue(one, other)) return [];
    const unit =
      leaf.kind === "number" && typeof other === "number" ? `\u00a0${prettyUnit(leaf.shown.unit)}`.trimEnd() : "";
    const [before, after] = [shown(one, leaf), shown(other, leaf)];
    const value = `${before === after ? "another" : after}${unit}`;
    return [{ pointer: leaf.pointer, name, change: `${before} → ${value}`, value }];
  });
}

/** The first few of them in one line: `Bump height 10 → 12 cm`. */
export const changesText = (changes: readonly FieldChange[], most = 3): string =>
  inOneLine(changes, most, ({ name, change }) => `${name} ${change}`);

/** What a scenario is called by what is special about it: `Bump height 12 cm, initial speed 40 km/h`. */
export const nameByChanges = (changes: readonly FieldChange[], most = 2): string =>
  inOneLine(changes, most, ({ name, value }, index) => `${index === 0 ? name : lowered(name)} ${value}`);

function inOneLine(
  changes: readonly FieldChange[],
  most: number,
  textOf: (change: FieldChange, index: number) => string,
): string {
  const rest = changes.length - most;
  const listed = changes.slice(0, rest === 1 ? most + 1 : most).map(textOf);
  return [...listed, ...(rest > 1 ? [`${rest} more`] : [])].join(", ");
}

export const OWN = "/own/";

const entriesOf = (value: unknown) => (typeof value === "object" && value !== null ? Object.entries(value) : []);

/** The scenario without options of controllers that are there no more: a service refuses them. */
export function withoutGone(form: Member | null, scenario: Scenario): Scenario {
  if (form === null || entriesOf(scenario.own).length === 0) return scenario;
  const below = (member: Member | undefined, pointer: string) =>
    member?.kind === "group" ? member.members.find((each) => each.pointer === pointer) : undefined;
  const laws = below(form, "/own");
  const own = entriesOf(scenario.own).flatMap(([id, options]) => {
    const law = below(laws, `${OWN}${id}`);
    return law ? [[id, entriesOf(options).filter(([name]) => below(law, `${OWN}${id}/${name}`))] as const] : [];
  });
  return { ...scenario, own: Object.fromEntries(own.map(([id, options]) => [id, Object.fromEntries(options)])) };
}
