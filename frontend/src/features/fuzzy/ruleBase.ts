/** A rule base as it is edited: every set and rule written out, the paper's where the scenario has none. */

import type { FuzzyAnswer, FuzzyRule, FuzzySet, JsonValue, Scenario } from "../../api/types";
import { getAt, setAt } from "../../scenario/path";

export const VARIABLES = ["speed_error", "distance", "torque"] as const;
export type Variable = (typeof VARIABLES)[number];
export type RuleBase = Readonly<Record<Variable, readonly FuzzySet[]>> & { readonly rules: readonly FuzzyRule[] };

export const TITLES: Readonly<Record<Variable, string>> = {
  speed_error: "Speed error",
  distance: "Distance",
  torque: "Torque",
};

/** As the scenario has it; the service checks what is in it. */
interface Stored {
  readonly inputs: Pick<RuleBase, "speed_error" | "distance"> | null;
  readonly output: readonly FuzzySet[] | null;
  readonly rules: readonly FuzzyRule[] | null;
}

const NONE: Stored = { inputs: null, output: null, rules: null };
const storedIn = (scenario: Scenario) => (getAt(scenario, "/fuzzy") ?? NONE) as unknown as Stored;

export function ruleBaseOf(scenario: Scenario, paper: FuzzyAnswer): RuleBase {
  const { inputs, output, rules } = storedIn(scenario);
  return {
    speed_error: inputs?.speed_error ?? paper.speed_error.sets,
    distance: inputs?.distance ?? paper.distance.sets,
    torque: output ?? paper.torque.sets,
    rules: rules ?? paper.rules,
  };
}

export type Edit = (before: RuleBase) => RuleBase;
/** A scenario with its rule base edited. */
export type Rewritten = (scenario: Scenario, edit: Edit) => Scenario;

/** The same where its rule base is `before`; what stays the paper's is left out of it. */
export function withRuleBase(scenario: Scenario, before: RuleBase, edit: Edit): Scenario {
  const { inputs, output, rules } = storedIn(scenario);
  const after = edit(before);
  const { speed_error, distance } = after;
  const same = speed_error === before.speed_error && distance === before.distance;
  const fuzzy = {
    inputs: same ? inputs : { speed_error, distance },
    output: after.torque === before.torque ? output : after.torque,
    rules: after.rules === before.rules ? rules : after.rules,
  };
  return setAt(scenario, "/fuzzy", fuzzy);
}

/** The paper's Table 1. */
export const withoutRuleBase = (scenario: Scenario): Scenario =>
  setAt(scenario, "/fuzzy", NONE as unknown as JsonValue);

/** Where a set of a variable stands in a scenario. */
export const setPointer = (variable: Variable, index: number) =>
  `/fuzzy/${variable === "torque" ? "output" : `inputs/${variable}`}/${index}` as const;

const named = (rule: FuzzyRule, variable: Variable) =>
  variable === "torque" ? rule.then : (rule.if[variable] ?? null);

const renamed = (rule: FuzzyRule, variable: Variable, to: string): FuzzyRule =>
  variable === "torque" ? { ...rule, then: to } : { ...rule, if: { ...rule.if, [variable]: to } };

/** A set put in place of another; rules go by its new name, and go where it is `null`. */
export function withSet(base: RuleBase, variable: Variable, index: number, set: FuzzySet | null): RuleBase {
  const name = base[variable][index]?.name;
  const sets = base[variable].flatMap((each, at) => (at === index ? (set ?? []) : each));
  if (set?.name === name) return { ...base, [variable]: sets };
  const rules = base.rules.flatMap((rule) =>
    named(rule, variable) !== name ? rule : set ? renamed(rule, variable, set.name) : [],
  );
  return { ...base, [variable]: sets, rules };
}

/** Another set in the middle of the universe, by a name that is free. */
export function withNewSet(base: RuleBase, variable: Variable, end: number): RuleBase {
  const names = base[variable].map(({ name }) => name);
  const name = Array.from({ length: names.length + 1 }, (_, index) => `new${index + 1}`).find(
    (each) => !names.includes(each),
  );
  const set = { name: name ?? "new", function: "trimf", corners: [0.4 * end, 0.5 * end, 0.6 * end] };
  return { ...base, [variable]: [...base[variable], set] };
}

/** A cell of the table of rules: `null` for any set of that input. */
export interface Cell {
  readonly speed_error: string | null;
  readonly distance: string | null;
}

const isOf = (rule: FuzzyRule, cell: Cell) =>
  (rule.if.speed_error ?? null) === cell.speed_error && (rule.if.distance ?? null) === cell.distance;

/** What the rules of a cell conclude; a rule base may have several there. */
export const conclusions = ({ rules }: RuleBase, cell: Cell): readonly string[] =>
  rules.filter((rule) => isOf(rule, cell)).map(({ then }) => then);

/** One rule, or none, in a cell. */
export function withConclusion(base: RuleBase, cell: Cell, then: string | null): RuleBase {
  const at = base.rules.findIndex((rule) => isOf(rule, cell));
  const rest = base.rules.filter((rule) => !isOf(rule, cell));
  const rules = then === null ? rest : rest.toSpliced(at < 0 ? rest.length : at, 0, { if: cell, then });
  return { ...base, rules };
}
