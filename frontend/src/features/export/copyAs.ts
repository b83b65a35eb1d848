/** The current run as a command or a script: only what differs from the paper is written out. */

import type { JsonObject, JsonValue, Scenario, StrategyId } from "../../api/types";
import { isChanged, leavesOf } from "../../scenario/differences";
import { getAt, setAt } from "../../scenario/path";
import { fieldsOf, type Group } from "../../scenario/schema";
import { requirementText, type Requirement } from "../../lab/requirements";
import { DEFAULT_VIEW } from "../../lab/address";
import { dotted } from "../../scenario/fields";

export interface CopyRequest {
  /** Where the service is. */
  readonly origin: string;
  readonly form: Group;
  readonly scenario: Scenario;
  /** Those that are shown. */
  readonly strategies: readonly StrategyId[];
  readonly roads: number;
  /** The strategy that changes refer to, shown or hidden; `null` where there is none. */
  readonly baseline: StrategyId | null;
  /** What the strategies are held to. */
  readonly requirements: readonly Requirement[];
}

/** A baseline that is hidden runs too. */
const drivenOf = ({ strategies, baseline }: CopyRequest): readonly StrategyId[] =>
  baseline === null || strategies.includes(baseline) ? strategies : [...strategies, baseline];

/** What is not as usual. */
const optionsOf = ({ roads, baseline }: CopyRequest) => ({
  ...(roads > 1 && { roads }),
  ...(baseline !== null && baseline !== DEFAULT_VIEW.baseline && { baseline }),
});

const heldTo = ({ requirements }: CopyRequest) => (requirements.length > 0 ? { requirements } : {});

/** The part of a scenario that is not the paper's; weights come whole. */
export function changedPart(scenario: Scenario, form: Group): JsonObject {
  return fieldsOf(form).reduce<Scenario>((part, field) => {
    const leaves = field.kind === "vector" ? field.items : [field];
    const value = getAt(scenario, field.pointer);
    return value !== undefined && leaves.some((leaf) => isChanged(scenario, leaf))
      ? setAt(part, field.pointer, value)
      : part;
  }, {});
}

/** Safe inside single quotes of a POSIX shell. */
const quoted = (text: string) => `'${text.replace(/'/g, `'\\''`)}'`;

const word = (text: string) => (/^[\w@%+=:,./-]+$/.test(text) ? text : quoted(text));

export function asCurl(request: CopyRequest): string {
  const { origin, form, scenario } = request;
  const body = JSON.stringify({
    scenario: changedPart(scenario, form),
    strategies: drivenOf(request),
    ...optionsOf(request),
    ...heldTo(request),
  });
  return `curl -sS ${word(`${origin}/api/v1/runs`)} -H 'content-type: application/json' -d ${quoted(body)}`;
}

export function asCommand(request: CopyRequest): string {
  const { origin, form, scenario } = request;
  const { roads, baseline } = optionsOf(request);
  const changes = leavesOf(form).flatMap((leaf) => {
    const value = getAt(scenario, leaf.pointer);
    if (value === undefined || !isChanged(scenario, leaf)) return [];
    return [`--set ${word(`${dotted(leaf.pointer)}=${typeof value === "string" ? value : JSON.stringify(value)}`)}`];
  });
  const options = [
    ...(roads === undefined ? [] : [`--roads ${roads}`]),
    ...(baseline === undefined ? [] : [`--baseline ${word(baseline)}`]),
  ];
  return [
    "ridelab run",
    ...changes,
    `--strategy ${word(drivenOf(request).join(","))}`,
    ...options,
    ...request.requirements.map((each) => `--require ${word(requirementText(each))}`),
    `--server ${word(origin)}`,
  ].join(" ");
}

/** Without members that say nothing. */
const plain = (requirement: Requirement): JsonObject =>
  Object.fromEntries(
    Object.entries(requirement).flatMap(([name, value]) =>
      (value ?? null) === null ? [] : [[name, value as JsonValue]],
    ),
  );

const INDENT = "    ";

/** A JSON value as Python writes it; what does not fit a line is broken by member. */
function literal(value: JsonValue, depth = 1): string {
  if (value === null) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value !== "object") return JSON.stringify(value);
  if (Array.isArray(value)) return `[${(value as readonly JsonValue[]).map((item) => literal(item)).join(", ")}]`;
  const members = Object.entries(value).map(([name, item]) => `${JSON.stringify(name)}: ${literal(item, depth + 1)}`);
  const line = `{${members.join(", ")}}`;
  if (line.length <= 76 && !line.includes("\n")) return line;
  const pad = INDENT.repeat(depth);
  return `{\n${members.map((member) => `${pad}${member},\n`).join("")}${INDENT.repeat(depth - 1)}}`;
}

export function asPython(request: CopyRequest): string {
  const { origin, form, scenario } = request;
  const strategies = drivenOf(request);
  const options = Object.entries(optionsOf(request)).map(([name, value]) => `, ${name}=${JSON.stringify(value)}`);
  const required = request.requirements.map((each) => `${INDENT}${literal(plain(each), 2)},`);
  const held = required.length > 0 ? ", requirements=requirements" : "";
  return [
    "from ridelab import Ridelab",
    "",
    `scenario = ${literal(changedPart(scenario, form))}`,
    ...(required.length > 0 ? ["requirements = [", ...required, "]"] : []),
    `with Ridelab(${JSON.stringify(origin)}) as ridelab:`,
    `${INDENT}run = ridelab.run(scenario, ${JSON.stringify(strategies).replace(/,/g, ", ")}${options.join("")}${held})`,
    "",
  ].join("\n");
}
