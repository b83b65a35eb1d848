/** What makes a result one that no real car would have had, or that is not comparable with the others. */

import type { Catalogue, Quantity, Summary } from "../../api/types";
import { formatInput, prettyUnit } from "../../units/format";

type Events = Summary["events"];

export interface Caveat {
  readonly event: string;
  /** A few words: `airborne 94 ms`. */
  readonly text: string;
  /** The catalogue's words for it. */
  readonly description: string;
}

type Wording = (value: number | boolean, quantity: Pick<Quantity, "unit" | "notable">) => string | null;

const amount = (value: number, unit: string) =>
  `${formatInput(value < 10 ? Number(value.toPrecision(2)) : Math.round(value))}\u00a0${prettyUnit(unit)}`;

/** In words from the size on that the catalogue says; `null` below it. */
const notable =
  (say: (shown: string) => string): Wording =>
  (value, quantity) =>
    typeof value === "number" && value >= quantity.notable ? say(amount(value, quantity.unit)) : null;

const WORDINGS: Readonly<Record<string, Wording>> = {
  airborne_ms: notable((shown) => `airborne ${shown}`),
  stop_contact_ms: notable((shown) => `on a bump stop ${shown}`),
  travel_exceeded_mm: notable((shown) => `${shown} over the travel limit`),
  target_reached: (value) => (value === false ? "target speed not reached" : null),
};

/** The events that are caveats of a result. */
export const CAVEAT_EVENTS = Object.keys(WORDINGS);

export function caveatsOf(events: Events | undefined, catalogue: Pick<Catalogue, "events">): readonly Caveat[] {
  return Object.entries(WORDINGS).flatMap(([event, wording]) => {
    const value = events?.[event];
    const quantity = catalogue.events.find(({ key }) => key === event);
    const text = value === null || value === undefined || quantity === undefined ? null : wording(value, quantity);
    return text === null ? [] : [{ event, text, description: `${quantity?.label}: ${quantity?.description}` }];
  });
}
