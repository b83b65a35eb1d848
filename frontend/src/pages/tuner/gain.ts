/** Whether a gain on the training roads is still there on the validation roads, in a sentence. */

import type { Comparison, ComparedPoint } from "../../api/types";
import { formatPercent } from "../../features/tables/change";

export type Keeps = "keeps" | "shrinks" | "unclear" | "worse" | "none";

export interface Gain {
  readonly trial: number;
  readonly objective: number;
  readonly keeps: Keeps;
  readonly text: string;
}

/** A gain that is smaller than this part of the training roads' has shrunk; the two means differ a little anyway. */
const MOSTLY = 0.9;
/** What is not a gain on the training roads [%]. */
const LEAST = 0.05;

function keepsOf(training: number, validation: number, verdict: string | undefined): Keeps {
  if (training > -LEAST) return "none";
  if (verdict === "worse") return "worse";
  if (verdict !== "better") return "unclear";
  return validation / training < MOSTLY ? "shrinks" : "keeps";
}

const interval = (low: number | null, high: number | null) =>
  low === null || high === null ? "" : ` (${formatPercent(low)} to ${formatPercent(high)})`;

const ENDING: Readonly<Record<Keeps, string>> = {
  keeps: "the gain holds",
  shrinks: "less of the gain is left there",
  unclear: "no certain gain, as the interval holds zero",
  worse: "the weights are tuned to the training roads and worse elsewhere",
  none: "no gain over the paper’s weights",
};

function gainOf(point: ComparedPoint, objective: number): Gain | null {
  if (point.roles.includes("paper"))
    return {
      trial: point.trial,
      objective,
      keeps: "none",
      text: "No weights that were tried are better than the paper’s on the training roads.",
    };
  const key = `objectives.${objective}`;
  const [training, validation] = [point.training[key]?.change, point.fresh[key]?.change];
  if (!training || !validation) return null;
  const keeps = keepsOf(training.value, validation.value, point.verdict?.[objective]);
  const text = `${formatPercent(training.value)} on the training roads, ${formatPercent(validation.value)}${interval(validation.low, validation.high)} on the validation roads: ${ENDING[keeps]}.`;
  return { trial: point.trial, objective, keeps, text };
}

/** Each objective at the point that is best for it. */
export function gainsOf({ points }: Comparison, objectives: number): readonly Gain[] {
  return Array.from({ length: objectives }, (_, index) => points.find(({ roles }) => roles.includes(`best.${index}`)))
    .map((point, index) => (point ? gainOf(point, index) : null))
    .filter((gain) => gain !== null);
}
