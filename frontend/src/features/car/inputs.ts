import type { Scenario } from "../../api/types";
import { getAt, type Pointer } from "../../scenario/path";

export type { Series } from "../../api/decode";
export type { Scenario } from "../../api/types";

/** A number of the scenario; `otherwise` where it is not there. */
export function numberAt(scenario: Scenario, pointer: Pointer, otherwise: number): number {
  const value = getAt(scenario, pointer);
  return typeof value === "number" ? value : otherwise;
}
