/** Who keeps the lead over a study's points, in a sentence. */

import { formatWhole } from "../../units/format";

export interface LeadOf {
  /** Share of the points at which the other strategy is worse, and better. */
  readonly worse: number;
  readonly better: number;
}

/** `LV control is better than LQR in 7 of 8 metrics at most points, in 5 of them at 95 % and more; worse in 1.` */
export function leadSentence(label: string, other: string, leads: readonly LeadOf[]): string {
  const count = (test: (lead: LeadOf) => boolean) => formatWhole(leads.filter(test).length);
  const [betterIn, certainlyBetterIn, worseIn] = [
    count(({ worse }) => worse > 0.5),
    count(({ worse }) => worse >= 0.95),
    count(({ better }) => better > 0.5),
  ];
  const certain =
    certainlyBetterIn === "0" ? "nowhere at 95 % of them" : `in ${certainlyBetterIn} at 95 % of them and more`;
  return `${label} is better than ${other} in ${betterIn} of ${leads.length} metrics at most points, ${certain}${worseIn === "0" ? "" : `; worse in ${worseIn}`}.`;
}
