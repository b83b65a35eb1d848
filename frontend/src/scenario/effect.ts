/** Which strategies use a field of the scenario, as the server says of each, and what to say of a field that none on the screen uses. */

import type { JsonValue, Scenario, Strategy } from "../api/types";
import { namedLeaves, OWN, type Leaf } from "./differences";
import { dotted, pointerOf } from "./fields";
import { valueText } from "./limits";
import { getAt, sameValue, type Pointer } from "./path";
import { findMember, optionOf, optionTitle, type Group } from "./schema";

type Condition = Strategy["reads_when"][number]["conditions"][number];
/** All of the conditions have to hold. */
type Need = readonly Condition[];
/** Of a strategy what is looked at. */
export type Reading = Pick<Strategy, "id" | "label" | "reads_when">;

/** What a strategy needs to use a field, one of which is enough: a slider asks for it at every step. */
const NEEDS = new WeakMap<Reading["reads_when"], Map<Pointer, readonly Need[]>>();

function needsOf({ reads_when }: Reading, pointer: Pointer): readonly Need[] {
  const known = NEEDS.get(reads_when) ?? new Map<Pointer, readonly Need[]>();
  NEEDS.set(reads_when, known);
  const found = known.get(pointer);
  if (found) return found;
  const name = `${dotted(pointer)}.`;
  const needs = reads_when
    .filter(({ fields }) => fields.some((each) => name.startsWith(`${each}.`)))
    .map(({ conditions }) => conditions);
  known.set(pointer, needs);
  return needs;
}

/** Of the edited scenario, and the form, which has the defaults of options that it lacks. */
export interface Edited {
  readonly form: Group;
  readonly scenario: Scenario;
}

/** No field: it follows from several. */
const HAS_BUMP = "road.has_bump";

function holds({ field, values, excluded }: Condition, edited: Edited): boolean {
  const value = field === HAS_BUMP ? hasBump(edited) : valueAt(pointerOf(field), edited);
  return values.some((each) => sameValue(each, value)) !== excluded;
}

function hasBump(edited: Edited): boolean {
  const bump = (name: string) => Number(valueAt(`/road/bump/${name}`, edited));
  const end = bump("start") + (bump("count") - 1) * bump("spacing") + bump("width");
  return end <= Number(valueAt("/road/length", edited));
}

const valueAt = (pointer: Pointer, { form, scenario }: Edited): JsonValue =>
  getAt(scenario, pointer) ?? defaultIn(form, pointer);

function defaultIn(form: Group, pointer: Pointer): JsonValue {
  const member = pointer.startsWith(OWN) ? findMember(form, pointer) : undefined;
  return member && member.kind !== "group" ? member.paperValue : null;
}

/** Whether a strategy's result depends on the field in this scenario. */
export const isUsed = (strategy: Reading, pointer: Pointer, edited: Edited): boolean =>
  needsOf(strategy, pointer).some((need) => need.every((condition) => holds(condition, edited)));

interface Looked {
  /** Every strategy there is. */
  readonly strategies: readonly Reading[];
  /** Ids of those that are shown. */
  readonly on: readonly string[];
}

/**
 * What to say of a field, or of several alike, that no shown strategy uses in this scenario; `null` where one does.
 * Where no strategy is shown, all of them are asked.
 */
export function unusedText(
  edited: Edited,
  pointer: Pointer,
  { strategies, on }: Looked,
  what: "this" | "these" = "this",
): string | null {
  const chosen = strategies.filter(({ id }) => on.includes(id));
  const shown = chosen.length > 0 ? chosen : strategies;
  if (shown.some((strategy) => isUsed(strategy, pointer, edited))) return null;
  const others = strategies.filter((strategy) => isUsed(strategy, pointer, edited));
  const need = others.length > 0 ? null : missing(shown, pointer, edited);
  if (need !== null) return saidOf(need, pointer, edited.form);
  // Where other values have to change too, those that then would.
  const users = others.length > 0 ? others : strategies.filter((each) => needsOf(each, pointer).length > 0);
  if (users.length === 0) return null;
  const names = listed(users.map(({ label }) => label));
  const common = others.length > 0 ? null : commonText(users, pointer, edited);
  if (common?.startsWith(WANTED)) return `${common}, by ${names}.`;
  if (common !== null) return `${common}. Only ${names} ${users.length === 1 ? "uses" : "use"} ${what}.`;
  return `No shown strategy uses ${what}. ${names} ${users.length === 1 ? "does" : "do"}.`;
}

/** What all of these strategies lack to use the field; `null` where they lack different things. */
function commonText(users: readonly Reading[], pointer: Pointer, edited: Edited): string | null {
  const texts = users.map((user) => saidOf(missing([user], pointer, edited) ?? [], pointer, edited.form));
  const [first = null] = texts;
  return texts.every((text) => text === first) ? first : null;
}

/** The fewest conditions that fail, rather on fields beside this one. */
function missing(strategies: readonly Reading[], pointer: Pointer, edited: Edited): Need | null {
  const failing = strategies
    .flatMap((strategy) => needsOf(strategy, pointer))
    .map((need) => need.filter((condition) => !holds(condition, edited)));
  const isElsewhere = (condition: Condition) => parent(pointerOf(condition.field)) !== parent(pointer);
  const size = (need: Need) => need.length + need.filter(isElsewhere).length / (need.length + 1);
  return failing.length === 0 ? null : failing.reduce((one, other) => (size(other) < size(one) ? other : one));
}

const MOST_NAMED = 3;
const [AND, OR] = [new Intl.ListFormat("en-GB"), new Intl.ListFormat("en-GB", { type: "disjunction" })];

function listed(labels: readonly string[]): string {
  const rest = labels.length - MOST_NAMED;
  return AND.format(rest > 1 ? [...labels.slice(0, MOST_NAMED), `${rest} more`] : labels);
}

const WANTED = "Used only with";

/** `Used only with State: Kalman`, `Without effect with Height: 0 cm`. */
function saidOf(need: Need, pointer: Pointer, form: Group): string {
  const [excluded, wanted] = [need.filter((each) => each.excluded), need.filter((each) => !each.excluded)];
  const [conditions, begins] = wanted.length > 0 ? [wanted, WANTED] : [excluded, "Without effect with"];
  return `${begins} ${AND.format(conditions.map((each) => conditionText(each, pointer, form)))}`;
}

function conditionText({ field, values }: Condition, pointer: Pointer, form: Group): string {
  if (field === HAS_BUMP) return "a bump that ends on the road";
  const place = pointerOf(field);
  const named = namedLeaves(form).find(({ leaf }) => leaf.pointer === place);
  if (!named) return `${field}: ${values.join(" or ")}`;
  const isBeside = parent(place) === parent(pointer);
  const part = findMember(form, parent(place))?.title ?? "";
  const isSaidByPart = part.toLowerCase().includes(named.leaf.title.toLowerCase());
  return `${isBeside ? named.leaf.title : isSaidByPart ? part : named.name}: ${OR.format(values.map((value) => valueIn(named.leaf, value)))}`;
}

const parent = (pointer: Pointer) => pointer.slice(0, pointer.lastIndexOf("/")) as Pointer;

function valueIn(leaf: Leaf, value: JsonValue): string {
  if (value === null) return "none";
  if (leaf.kind === "choice") return optionTitle(optionOf(value));
  return leaf.kind === "number" && typeof value === "number" ? valueText(leaf, value) : JSON.stringify(value);
}
