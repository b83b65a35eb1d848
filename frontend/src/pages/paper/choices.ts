/** Which readings are chosen. The address carries them, so that a page of them can be shared. */

import { useNavigate, useSearch } from "@tanstack/react-router";
import { useCallback } from "react";
import type { PaperInterpretation, PaperReading } from "../../api/types";

/** Reading → choice; what is left out is as in the named set under `interpretation`, which is `default` where it is left out. `seeds` may stand there too. */
export type Choices = Readonly<Record<string, string>>;

export const NONE_CHOSEN: Choices = {};

/** They have names of the server's: all there is in the address. */
export const readChoices = (search: Readonly<Record<string, unknown>>): Choices =>
  Object.fromEntries(
    Object.entries(search).flatMap(([name, value]) => (typeof value === "string" ? [[name, value]] : [])),
  );

const DEFAULT = "default";

/** The named set that all switches stand at which are not turned by themselves. */
export const setOf = (choices: Choices, interpretations: readonly PaperInterpretation[]) =>
  interpretations.find(({ id }) => id === (choices.interpretation ?? DEFAULT));

/** Where a reading stands in a named set. */
export const standardOf = ({ id, chosen }: Pick<PaperReading, "id" | "chosen">, set: PaperInterpretation | undefined) =>
  set?.choices[id] ?? chosen;

/** The choices with one made anew: that of the named set leaves no trace. */
export function withChoice(choices: Choices, id: string, choice: string, standard: string): Choices {
  const others = without(choices, (name) => name === id);
  return choice === standard ? others : { ...others, [id]: choice };
}

/** Every reading as its named set has it; the rest of the address stays. */
export const withoutChoices = (choices: Choices, readings: readonly PaperReading[]) =>
  without(choices, (name) => readings.some(({ id }) => id === name));

/** Every reading as that named set has it. */
export function withSet(choices: Choices, readings: readonly PaperReading[], name: string): Choices {
  const others = without(withoutChoices(choices, readings), (key) => key === "interpretation");
  return name === DEFAULT ? others : { ...others, interpretation: name };
}

const without = (choices: Choices, left: (name: string) => boolean): Choices =>
  Object.fromEntries(Object.entries(choices).filter(([name]) => !left(name)));

export function useChoices() {
  const search = useSearch({ from: "/paper" });
  const navigate = useNavigate();
  const choose = useCallback(
    (next: Choices) => void navigate({ to: ".", search: next, resetScroll: false }),
    [navigate],
  );
  return [search, choose] as const;
}
