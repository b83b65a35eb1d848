/** Which readings are chosen. The address carries them, so that a page of them can be shared. */

import { useEffect, useState } from "react";
import type { PaperReading } from "../api/types";

/** Reading → choice; what is left out is as Ridelab reads it. `seeds` may stand there too. */
export type Choices = Readonly<Record<string, string>>;

export const NONE_CHOSEN: Choices = {};

export const readChoices = (search: string): Choices => Object.fromEntries(new URLSearchParams(search));

export function formatChoices(choices: Choices): string {
  const text = new URLSearchParams(choices).toString();
  return text === "" ? "" : `?${text}`;
}

/** The choices with one made anew: the default leaves no trace. */
export function withChoice(choices: Choices, { id, choices: offered }: PaperReading, choice: string): Choices {
  const others = Object.fromEntries(Object.entries(choices).filter(([name]) => name !== id));
  const isDefault = offered.some((each) => each.id === choice && each.default);
  return isDefault ? others : { ...others, [id]: choice };
}

/** Every reading as Ridelab has it; the rest of the address stays. */
export function withoutChoices(choices: Choices, readings: readonly PaperReading[]): Choices {
  return Object.fromEntries(Object.entries(choices).filter(([name]) => !readings.some(({ id }) => id === name)));
}

/** The readings that are not Ridelab's. */
export const changedReadings = (readings: readonly PaperReading[]) =>
  readings.filter(({ chosen, choices }) => choices.some((choice) => choice.id === chosen && !choice.default));

export function useChoices() {
  const [choices, setChoices] = useState(() => readChoices(window.location.search));
  useEffect(() => {
    const read = () => setChoices(readChoices(window.location.search));
    window.addEventListener("popstate", read);
    return () => window.removeEventListener("popstate", read);
  }, []);
  const choose = (next: Choices) => {
    setChoices(next);
    window.history.pushState(null, "", window.location.pathname + formatChoices(next));
  };
  return [choices, choose] as const;
}
