/** A scenario with a part of it from the library. */

import type { CreatedRoad, Scenario } from "../api/types";
import { completed } from "./differences";
import type { Item } from "./library";
import { setAt } from "./path";
import type { Group } from "./schema";

export type Content = Pick<Item, "kind" | "value">;

/** The edited scenario with an item in place of its own. */
export function withItem(scenario: Scenario, { kind, value }: Content, form: Group): Scenario {
  if (kind === "scenario") return completed(form, value);
  if (kind === "requirements") return scenario;
  // A road's value is what the server said of it when it was uploaded.
  if (kind === "road") return onRoad(scenario, value as unknown as CreatedRoad);
  return completed(form, setAt(scenario, "/vehicle", value));
}

/**
 * It ends where the road does; the largest bump found in it, if any, is the scenario's, and none is added. Without one
 * its place is beyond the road's end, so that no car brakes for it and no metric has a window there.
 */
export function onRoad(scenario: Scenario, road: Pick<CreatedRoad, "id" | "length" | "bumps">): Scenario {
  const driven = setAt(setAt(scenario, "/road/profile", road.id), "/road/length", road.length);
  const [bump] = road.bumps;
  if (bump !== undefined) return onBump(driven, road.length, bump);
  return setAt(setAt(driven, "/road/bump/height", 0), "/road/bump/start", road.length);
}

/** The bump that counts: the car brakes for it and the stages go by it, but none is added to the road. */
export function onBump(scenario: Scenario, length: number, bump: CreatedRoad["bumps"][number]): Scenario {
  const start = Math.max(1, bump.start);
  const width = Math.min(bump.width, Number((length - start).toFixed(2)));
  const there = { start, width, height: 0, count: 1 };
  return Object.entries(there).reduce((result, [name, value]) => setAt(result, `/road/bump/${name}`, value), scenario);
}
