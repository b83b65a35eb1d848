/** Requirements: metrics with limits, as the command line writes them; addresses carry them so. */

import type { Requirement, RequirementResult, StrategyId } from "../api/types";
import { isLike } from "../lib/storage";

export type { Requirement, RequirementResult };

/** What a requirement's limit is: one of the three that it has. */
export type LimitKind = "max" | "min" | "max_change";

export interface Limit {
  readonly kind: LimitKind;
  /** In SI, of a change in percent. */
  readonly value: number;
}

export function limitOf({ max, min, max_change }: Pick<Requirement, LimitKind>): Limit {
  if (typeof max_change === "number") return { kind: "max_change", value: max_change };
  return typeof min === "number" ? { kind: "min", value: min } : { kind: "max", value: max ?? 0 };
}

/** `lv,lqr:bump.body_acceleration.peak<3`, `travel_time>10`, `bump.rear_tyre_load.peak<-20%`. */
export function requirementText(requirement: Requirement): string {
  const { kind, value } = limitOf(requirement);
  const who = requirement.strategies ? `${requirement.strategies.join(",")}:` : "";
  if (kind === "max_change") return `${who}${requirement.metric}<${value < 0 ? "" : "+"}${value}%`;
  return `${who}${requirement.metric}${kind === "min" ? ">" : "<"}${value}`;
}

const TEXT = /^(?:([\w,:-]+):)?([\w.]+)([<>])([+-]?[\d.]+(?:e[+-]?\d+)?)(%?)$/i;

function readRequirement(text: string): readonly Requirement[] {
  const [, who, metric = "", sign, number, percent] = TEXT.exec(text) ?? [];
  const value = Number(number);
  if (number === undefined || !Number.isFinite(value)) return [];
  const kind: LimitKind = percent ? "max_change" : sign === ">" ? "min" : "max";
  return [{ metric, [kind]: value, ...(who !== undefined && { strategies: who.split(",") }) }];
}

/** As many as the service takes. */
export const MOST_REQUIREMENTS = 64;

export const requirementsText = (all: readonly Requirement[]) => all.map(requirementText).join(";");

/** Those of an address; what is none is left out. */
export const readRequirements = (text = ""): readonly Requirement[] =>
  text.split(";").flatMap(readRequirement).slice(0, MOST_REQUIREMENTS);

/** The requirements in a file or in the library; none where there is anything else. */
export function requirementsIn(value: unknown): readonly Requirement[] {
  if (!isLike<readonly Requirement[]>([{ metric: "" }], value)) return [];
  if (!value.every(({ max, min, max_change }) => typeof (max ?? min ?? max_change) === "number")) return [];
  const read = readRequirements(requirementsText(value));
  return read.length === value.length ? read : [];
}

/** What is sent with a question about these strategies: those that are about one of them. */
export function requiredOfThese(
  requirements: readonly Requirement[],
  names: readonly StrategyId[],
  baseline: StrategyId,
): { readonly requirements?: readonly Requirement[]; readonly baseline?: StrategyId } {
  const about = requirements.flatMap((requirement) => {
    const strategies = requirement.strategies?.filter((id) => names.includes(id));
    if (strategies?.length === 0) return [];
    return [strategies ? { ...requirement, strategies } : requirement];
  });
  if (about.length === 0) return {};
  return { requirements: about, ...(names.includes(baseline) && { baseline }) };
}

/** By run how it keeps what is required; a run under way, or one that could not be asked about, has no entry. */
export type Judged = Readonly<Record<string, readonly RequirementResult[]>>;
