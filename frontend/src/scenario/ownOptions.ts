/** Options of controllers of one's own, `own.ID.OPTION`: there as long as their file is. */

import type { Scenario } from "../api/types";
import type { Member } from "./schema";

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
