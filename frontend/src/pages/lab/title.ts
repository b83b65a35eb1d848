/** The browser tab's title: what this scenario is about, in a few words. */

import type { Scenario } from "../../api/types";
import { getAt } from "../../scenario/path";

export function pageTitle(scenario: Scenario): string {
  const height = getAt(scenario, "/road/bump/height");
  const from = getAt(scenario, "/speed/initial_speed_kmh");
  const to = getAt(scenario, "/speed/target_speed_kmh");
  if (typeof height !== "number" || typeof from !== "number" || typeof to !== "number") return "Ridelab";
  const count = getAt(scenario, "/road/bump/count");
  const several = typeof count === "number" && count > 1 ? `${count} × ` : "";
  const kind = getAt(scenario, "/road/bump/shape") === "kerb" ? "kerb" : height > 0 ? "bump" : "pothole";
  const obstacle = height === 0 ? "no bump" : `${several}${Math.abs(height * 1000).toFixed(0)} mm ${kind}`;
  return `${obstacle}, ${from} → ${to} km/h · Ridelab`;
}
