/** Scenarios stored under an older schema version as today's: the steps of sim_core/scenario/versions.py. */

import type { JsonObject, JsonValue } from "../api/types";
import { getAt, setAt, type Pointer } from "./path";

/** What a scenario of a version means by a field it leaves out, where that is not today's default. */
const UNSTATED: readonly (readonly [version: number, field: Pointer, value: JsonValue])[] = [
  [1, "/estimation/knows_preview", false], // core 0.3.0 and before
];

export const SCHEMA_VERSION = 2;

/** `version` is the one it was stored under. */
export function upgraded(scenario: JsonObject, version: number): JsonObject {
  const left = UNSTATED.filter(([last, field]) => version <= last && getAt(scenario, field) === undefined);
  return left.reduce((result, [, field, value]) => setAt(result, field, value), scenario);
}

/** Whether a program wrote the scenario, with every field that there was: a person writes what differs from the paper. */
export const isWrittenOut = (scenario: JsonObject) =>
  ["kind", "acceleration_noise", "deflection_noise", "pitch_rate_noise"].every(
    (name) => getAt(scenario, `/estimation/${name}`) !== undefined,
  );
