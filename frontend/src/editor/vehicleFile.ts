/** Vehicle files: JSON with a member `vehicle`, as the command line writes them; a scenario or a run has one too. */

import type { JsonObject, JsonValue } from "../api/types";
import { fieldsOf, type Group } from "./schema";

const isObject = (value: unknown): value is JsonObject => typeof value === "object" && value !== null && !Array.isArray(value);

/** The paper's vehicle, as the form's schema states it. */
export function standardVehicle(group: Group): JsonObject {
  return Object.fromEntries(fieldsOf(group).map(({ pointer, standard }) => [pointer.slice(group.pointer.length + 1), standard]));
}

/**
 * The whole vehicle that a file holds; a field it leaves out takes the paper's value.
 * @throws {Error} Its message says what is wrong with the file.
 */
export function readVehicleFile(text: string, group: Group): JsonObject {
  let content: unknown;
  try {
    content = JSON.parse(text);
  } catch {
    throw new Error("This file is not JSON");
  }
  const holder = isObject(content) && isObject(content.scenario) ? content.scenario : content;
  const vehicle = isObject(holder) ? holder.vehicle : undefined;
  if (!isObject(vehicle)) throw new Error("This file has no member vehicle");
  const standard = standardVehicle(group);
  const unknown = Object.keys(vehicle).filter((name) => !(name in standard));
  if (unknown.length > 0) throw new Error(`Unknown field ${unknown.join(", ")}; there are ${Object.keys(standard).join(", ")}`);
  return { ...standard, ...vehicle };
}

/** What a vehicle is saved as. */
export function vehicleFile(vehicle: JsonValue | undefined, label: string): string {
  return `${JSON.stringify({ label, vehicle: vehicle ?? {} }, null, 1)}\n`;
}
