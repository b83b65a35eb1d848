/** A scenario on a road that was just sent, and without one. */

import type { CreatedRoad, Scenario } from "../api/types";
import { setAt } from "./path";

/** It ends where the road does; the largest bump found in it is the scenario's, and none is added. */
export function onRoad(scenario: Scenario, road: Pick<CreatedRoad, "id" | "length" | "bumps">): Scenario {
  const driven = setAt(setAt(scenario, "/road/profile", road.id), "/road/length", road.length);
  const [bump] = road.bumps;
  if (bump === undefined) return driven;
  const start = Math.max(1, bump.start);
  const width = Math.min(bump.width, Number((road.length - start).toFixed(2)));
  const there = { start, width, height: 0, count: 1 };
  return Object.entries(there).reduce((result, [name, value]) => setAt(result, `/road/bump/${name}`, value), driven);
}
