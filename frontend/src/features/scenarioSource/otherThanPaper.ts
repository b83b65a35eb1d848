/** What a scenario has other than the paper, in a sentence. */

import type { Scenario } from "../../api/types";
import { isChanged, leavesOf } from "../../scenario/differences";
import { valueText } from "../../scenario/limits";
import { getAt } from "../../scenario/path";
import { optionOf, optionTitle, type Group } from "../../scenario/schema";
import { roadName } from "../../scenario/library";
import { dotted, sweepFields } from "../../scenario/fields";

const MOST_NAMED = 6;

/** `swept` are dotted names of fields, or of parts, that are told elsewhere. */
export function otherThanPaper(scenario: Scenario, form: Group, swept: readonly string[] = []): string {
  const texts = leavesOf(form).flatMap((leaf) =>
    leaf.kind === "text" || leaf.kind === "data" ? [{ name: dotted(leaf.pointer), title: leaf.title, leaf }] : [],
  );
  const other = [...sweepFields(form), ...texts].filter(
    ({ name, leaf }) =>
      isChanged(scenario, leaf) && !swept.some((each) => each === name || name.startsWith(`${each}.`)),
  );
  if (other.length === 0) return swept.length > 0 ? "Everything else as in the paper." : "As in the paper.";
  const named = other.slice(0, MOST_NAMED).map(({ title, leaf }) => {
    const value = getAt(scenario, leaf.pointer);
    if (leaf.kind === "text" && typeof value === "string") return `${title} ${roadName(value)}`;
    if (leaf.kind === "data") return `${title} own`;
    const text =
      typeof value === "number" && leaf.kind === "number"
        ? valueText(leaf, value)
        : value === null || value === undefined
          ? "off"
          : optionTitle(optionOf(value));
    return `${title} ${text}`;
  });
  const more = other.length - named.length;
  return `Other than the paper: ${named.join(", ")}${more > 0 ? ` and ${more} more` : ""}.`;
}
