/** What a file holds, seen from its content, and what an item is exported as. */

import type { DescribedTable, JsonObject } from "../../api/types";
import { requirementsIn } from "../../lab/requirements";
import { getAt } from "../../scenario/path";
import type { ScenarioSchema } from "../../scenario/schema";
import { isWrittenOut, upgraded } from "../../scenario/versions";
import type { Item, ItemKind } from "../../scenario/library";

export type Content =
  | {
      readonly kind: "scenario";
      readonly value: JsonObject;
      readonly label: string | null;
      /** Its measured road as CSV. */ readonly road: string | null;
    }
  | { readonly kind: "vehicle" | "requirements"; readonly value: JsonObject; readonly label: string | null };

/** A table of a road or a drive that has to be asked about, or shown before it is taken. */
export interface UnclearTable {
  readonly name: string;
  readonly file: File;
  readonly described: DescribedTable;
}

/** A grid of heights, on which the wheels' places have to be asked for. */
interface UnclearGrid {
  readonly name: string;
  readonly grid: File;
}

export type Unclear = UnclearTable | UnclearGrid;

/** Where both wheels run beside a grid's reference line, to the left [m]; `null` is where the service puts them. */
export interface Wheels {
  readonly left: number | null;
  readonly right: number | null;
}

export interface OpenOptions {
  /** The part to take from a file that has more. */
  readonly wanted?: ItemKind | undefined;
  /** What is said of a table; asked for where it is left out and the table is not clear. */
  readonly table?: string | undefined;
  /** On grids; asked for where they are left out. */
  readonly wheels?: Wheels | undefined;
  /** Whether they go into the library; they do where it is left out. */
  readonly inLibrary?: boolean;
}

export type Exported = Pick<Item, "kind" | "name" | "value">;

const isObject = (value: unknown): value is JsonObject =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const text = (value: unknown) => (typeof value === "string" ? value : null);

const EXPECTED =
  "Expected a scenario, a vehicle or requirements as JSON, or a measured road or a recorded drive as a table";

/** An OpenCRG file: its values begin behind a line of dollars. */
export const isOpenCrg = (text: string): boolean => /^\$\$\$\$/m.test(text);

export const isJson = (name: string, text: string): boolean => /\.json$/i.test(name) || /^\s*[[{]/.test(text);

/**
 * What a file of JSON holds. A run holds its scenario.
 * @throws {Error} Its message says what was expected; the values are for the server to check.
 */
export function readFile(content: string, form: ScenarioSchema): Content {
  const whole = parsed(content);
  const requirements = requirementsIn(isObject(whole) ? whole.requirements : whole);
  if (requirements.length > 0)
    return { kind: "requirements", value: { requirements }, label: isObject(whole) ? text(whole.label) : null };
  if (!isObject(whole)) throw new Error(EXPECTED);
  const scenario = isObject(whole.scenario) ? whole.scenario : whole;
  // A run and what `ridelab tune --out` writes say no version; what a person wrote is today's.
  const version = whole.schema_version ?? (isObject(whole.scenario) || isWrittenOut(scenario) ? 1 : form.version);
  checkVersion(version, form.version);
  const parts = form.members.map(({ pointer }) => pointer.slice(1));
  const named = Object.keys(scenario).filter((part) => parts.includes(part));
  const label = text(whole.label);
  if (scenario === whole && named.join() === "vehicle" && isObject(scenario.vehicle))
    return { kind: "vehicle", value: scenario.vehicle, label };
  if (named.length === 0) throw new Error(`${EXPECTED}. A scenario has one of the members ${parts.join(", ")}`);
  return { kind: "scenario", value: upgraded(scenario, version), label, road: text(whole.measured_road) };
}

function checkVersion(version: unknown, newest: number): asserts version is number {
  if (Number.isInteger(version) && (version as number) <= newest) return;
  if (typeof version !== "number") throw new Error("The schema_version of this file is not a number");
  throw new Error(
    `This file comes from a newer version of Ridelab: it has schema version ${version}, and this Ridelab reads up to ${newest}. Update this Ridelab to open it`,
  );
}

function parsed(content: string): unknown {
  try {
    return JSON.parse(content);
  } catch (error) {
    throw new Error(`This file is not JSON. ${error instanceof Error ? error.message : ""}`, { cause: error });
  }
}

/** The measured road that an item needs. */
export function roadOf({ kind, value }: Exported): string | null {
  return text(kind === "road" ? value.id : kind === "scenario" ? getAt(value, "/road/profile") : null);
}

/** `road` is the content of its measured road. */
export function fileOf(
  { kind, name, value }: Exported,
  version: number,
  road: string | null,
): { readonly name: string; readonly type: string; readonly text: string } {
  const stem = name.replace(/[^\p{L}\p{N} ().,_-]+/gu, "_");
  if (kind === "road") return { name: `${stem}.csv`, type: "text/csv", text: road ?? "" };
  const content = {
    schema_version: version,
    label: name,
    [kind]: kind === "requirements" ? value.requirements : value,
    ...(road !== null && { measured_road: road }),
  };
  return { name: `${stem}.json`, type: "application/json", text: `${JSON.stringify(content, null, 1)}\n` };
}
