/** The sets of weights a tuning is about: the paper's, the scenario's own, the best ones. */

import type { Trial, Tuning } from "../../api/types";
import type { RunInLab } from "../../ui/openInLab";
import type { ShownNumber } from "./figures";
import type { Tunable } from "./space";

export interface Point {
  readonly trial: Trial;
  /** `Paper`, `Best: Eq. 16, whole run`, `Balanced`, all that it is. */
  readonly names: readonly string[];
  readonly isPaper: boolean;
}

/** What the first trial is called. */
export const firstName = ({ source }: Pick<Tuning, "source">) => (source === null ? "The paper’s" : "The defaults");

/** One entry a trial, whatever it is at once; the paper's first. */
export function pointsOf(tuning: Tuning, labels: readonly string[]): readonly Point[] {
  const { paper, own, best, knee } = tuning;
  const several = best.length > 1;
  const named: readonly (readonly [Trial | null, string])[] = [
    [paper, firstName(tuning)],
    [own, "The scenario’s"],
    ...best.map((trial, index) => [trial, several ? `Best: ${labels[index] ?? ""}` : "Best"] as const),
    [knee, "Balanced"],
  ];
  const points = new Map<number, Point>();
  for (const [trial, name] of named) {
    if (!trial) continue;
    const names = [...(points.get(trial.number)?.names ?? []), name];
    points.set(trial.number, { trial, names, isPaper: trial.number === paper?.number });
  }
  return [...points.values()];
}

/** What a role of the comparison is called. */
export function roleName(role: string, labels: readonly string[], first: string): string {
  if (role === "paper") return first;
  if (role === "scenario") return "The scenario’s";
  if (role === "knee") return "Balanced";
  const [, index] = /^best\.(\d+)$/.exec(role) ?? [];
  return labels.length > 1 && index !== undefined ? `Best: ${labels[Number(index)] ?? ""}` : "Best";
}

/** What a tuning's page gives its cards. */
export interface TuningParts {
  readonly tuning: Tuning;
  readonly objectives: readonly ShownNumber[];
  readonly limits: readonly ShownNumber[];
  readonly tunable: Tunable;
  readonly points: readonly Point[];
  /** The tuned strategy's. */
  readonly colour: string;
  readonly load: RunInLab<Trial>;
}
