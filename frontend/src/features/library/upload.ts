/** Reads files of scenarios, vehicles and measured roads, and has the server check them. */

import type { QueryClient } from "@tanstack/react-query";
import { api } from "../../api/client";
import { ask, askFile } from "../../api/http";
import { ApiProblem, type FieldError, messageOf } from "../../api/problem";
import type { CreatedRoad, DescribedTable, JsonObject, JsonValue, Scenario } from "../../api/types";
import { completed, namedLeaves, type Leaf } from "../../scenario/differences";
import { sameValue, setAt, getAt, type Pointer } from "../../scenario/path";
import { type ScenarioSchema, findMember, optionTitle, type NumberField } from "../../scenario/schema";
import { DEFAULT_VIEW } from "../../lab/address";
import { requirementsIn, type Requirement } from "../../lab/requirements";
import { presetsQuery, schemaQuery, vehiclesQuery } from "../../server/queries";
import {
  readFile,
  type Content,
  fileOf,
  isJson,
  isOpenCrg,
  roadOf,
  type Exported,
  type OpenOptions,
  type Unclear,
  type Wheels,
} from "./files";
import { KINDS, kindWord, type Item, type ItemKind, ownLibrary } from "../../scenario/library";
import { withItem } from "../../scenario/withItem";
import { limitText, valueText } from "../../scenario/limits";
import { download } from "../../lib/download";

interface Opened extends Pick<Item, "kind" | "value" | "name"> {
  /** What to beware of: said beside the file's name. */
  readonly cautions?: readonly string[];
  readonly warnings: readonly string[];
}

export interface Outcome {
  /** With what the files hold in place of its own. */
  readonly scenario: Scenario;
  /** In place of the lab's; `null` where no file has any. */
  readonly requirements: readonly Requirement[] | null;
  readonly lines: readonly string[];
  readonly isWrong: boolean;
  /** Those whose columns have to be asked for. */
  readonly asked: readonly Unclear[];
}

/** What of a file is looked at to see what it is [characters]. */
const HEAD = 1_000_000;
const OPENCRG = "application/x-opencrg";
/** In a file of ours, which has the heights of its road alone. */
const EXPORTED = "# Ridelab road ";

/** Opens the files in `newest()`. */
export async function openAll(
  files: readonly File[],
  newest: () => Scenario,
  queries: QueryClient,
  { wanted, wheels, table, inLibrary = true }: OpenOptions,
): Promise<Outcome> {
  const [form, presets, vehicles] = await Promise.all([
    queries.query({ ...schemaQuery, staleTime: "static" }),
    queries.query({ ...presetsQuery, staleTime: "static" }),
    queries.query({ ...vehiclesQuery, staleTime: "static" }),
  ]);
  const builtIn = [
    ...presets.map(({ scenario }) => scenario),
    ...vehicles.map(({ vehicle }) => completed(form, { vehicle }).vehicle),
  ];
  const wrong: string[] = [];
  const opened: Opened[] = [];
  const asked: Unclear[] = [];
  for (const file of files) {
    try {
      const head = await file.slice(0, HEAD).text();
      if (isOpenCrg(head)) {
        if (wheels || head.includes(EXPORTED)) opened.push(await uploadGrid(file, wheels));
        else asked.push({ name: file.name, grid: file });
      } else if (isJson(file.name, head)) opened.push(await upload(file.name, await file.text(), form, wanted));
      else if (table !== undefined) opened.push(roadItem(stemOf(file.name), await uploadRoad(file, table)));
      else {
        const described = await describe(file);
        if (isClear(described)) opened.push(roadItem(stemOf(file.name), await uploadRoad(file)));
        else asked.push({ name: file.name, file, described });
      }
    } catch (error) {
      wrong.push(`${file.name}: ${messageOf(error)}`);
    }
  }
  const added = (content: Opened) => (inLibrary ? addToLibrary(content, builtIn) : openedLine(content));
  // A vehicle and a road belong into the scenario that came with them.
  opened.sort((one, other) => KINDS.indexOf(one.kind) - KINDS.indexOf(other.kind));
  const scenario = opened.reduce((before, content) => withItem(before, content, form), newest());
  const required = opened.findLast(({ kind }) => kind === "requirements");
  return {
    scenario,
    requirements: required ? requirementsIn(required.value.requirements) : null,
    lines: [
      ...wrong,
      ...opened.flatMap((content) => [[added(content), ...(content.cautions ?? [])].join(" "), ...content.warnings]),
    ],
    isWrong: wrong.length > 0,
    asked,
  };
}

/** The content of a file as the server understands it: complete, in SI units, and within every limit. */
async function upload(name: string, text: string, form: ScenarioSchema, wanted: ItemKind | undefined): Promise<Opened> {
  const content = readFile(text, form);
  const stem = stemOf(name);
  if (wanted === "vehicle" && content.kind === "scenario" && !("vehicle" in content.value))
    throw new Error("This file has no vehicle");
  if (content.kind === "requirements") return { ...content, name: content.label ?? stem, warnings: [] };
  const { scenario, warnings } = await checked(content, form);
  const kind = wanted === "vehicle" ? wanted : content.kind;
  return {
    kind,
    name: content.label ?? stem,
    value: kind === "vehicle" ? (scenario.vehicle as JsonObject) : scenario,
    warnings,
  };
}

const stemOf = (name: string) => name.replace(/\.\w+$/, "") || "File";

/** Its head, as the library keeps it. */
function roadItem(name: string, { cautions, warnings, id, length, samples, bumps }: CreatedRoad): Opened {
  const value = { id, length, samples, bumps };
  return { kind: "road", name, value, cautions: cautions.map(({ text }) => text), warnings };
}

async function uploadGrid(file: File, wheels: Wheels | undefined): Promise<Opened> {
  const body = new Blob([file], { type: OPENCRG }) as unknown as string; // the API's description has bytes as text
  return roadItem(stemOf(file.name), await ask("post", "/roads", { body, query: { ...wheels } }));
}

const asTable = (file: Blob | string) => new Blob([file], { type: "text/csv" }) as unknown as string;

const uploadRoad = (file: Blob | string, table?: string) =>
  ask("post", "/roads", { body: asTable(file), query: { table: table ?? null } });

/** How the server reads a table, with what is said of it. */
export const describe = (file: File, table?: string): Promise<DescribedTable> =>
  ask("post", "/roads", { body: asTable(file), query: { dry_run: true, table: table ?? null } });

/** Sends a recorded drive. */
export const uploadDrive = (file: File, table: string) =>
  ask("post", "/recordings", { body: asTable(file), query: { table } });

/** A road that says itself what it is needs nobody to look at it. */
const isClear = ({ table: { kind, questions, columns } }: DescribedTable) =>
  kind === "road" &&
  questions.length === 0 &&
  columns.every(({ means, unit, title }) => means !== null && title.includes(unit));

async function checked(
  content: Content,
  form: ScenarioSchema,
): Promise<{ readonly scenario: Scenario; readonly warnings: readonly string[] }> {
  const road = content.kind === "scenario" && content.road !== null ? await uploadRoad(content.road) : null;
  const sent =
    content.kind === "vehicle"
      ? { vehicle: content.value }
      : road
        ? setAt(content.value, "/road/profile", road.id)
        : content.value;
  try {
    const { scenario } = await api.createRun(sent, [DEFAULT_VIEW.baseline]);
    return { scenario, warnings: road ? [...road.cautions.map(({ text }) => text), ...road.warnings] : [] };
  } catch (error) {
    if (!(error instanceof ApiProblem) || error.errors.length === 0) throw error;
    throw new Error(faultsOf(form, sent, error.errors).join(". "), { cause: error });
  }
}

const openedLine = ({ kind, name }: Opened) => `The ${kindWord(kind)} “${name}” is opened.`;

/** Adds it to the library, except where the server has it by a name; returns what to say of it. */
function addToLibrary(opened: Opened, builtIn: readonly (JsonValue | undefined)[]): string {
  const { kind, name, value } = opened;
  const word = kindWord(kind);
  if (builtIn.some((each) => sameValue(each, value))) return openedLine(opened);
  try {
    return `The ${word} “${ownLibrary.add(kind, name, value)}” is opened, and in the library.`;
  } catch (error) {
    return `The ${word} “${name}” is opened, but not in the library. ${messageOf(error)}.`;
  }
}

/** A sentence for each error; what the form cannot explain stays as the server says it. */
export function faultsOf(form: ScenarioSchema, scenario: Scenario, errors: readonly FieldError[]): readonly string[] {
  const leaves = namedLeaves(form);
  return errors.map(({ pointer, message }) => {
    const place = pointer.replace(/^\/scenario(?=\/|$)/, "") as Pointer | "";
    const match = leaves.find(({ leaf }) => leaf.pointer === place);
    if (match) return `${match.name}: ${wrong(match.leaf, getAt(scenario, match.leaf.pointer)) ?? message}`;
    const member = place === "" ? undefined : findMember(form, place);
    if (!member) return place === "" ? message : `${place.slice(1).replace(/\//g, ".")}: ${message}`;
    const { title } = member;
    if (member.kind === "vector") return `${title}: Needs ${member.items.length} numbers`;
    return `${title}: ${isGroup(getAt(scenario, member.pointer)) ? message : "Needs its fields by name, in braces"}`;
  });
}

const isGroup = (value: JsonValue | undefined) => typeof value === "object" && value !== null && !Array.isArray(value);

/** `null` where the value is right by itself. */
function wrong(leaf: Leaf, value: JsonValue | undefined): string | null {
  if (leaf.kind === "number") return wrongNumber(leaf, value);
  if (leaf.kind === "text")
    return typeof value === "string" && /^\w[\w-]{21}$/.test(value) ? null : "Needs the id of a measured road";
  if (leaf.kind === "data") return null;
  if (leaf.onOff) return typeof value === "boolean" ? null : "Must be true or false";
  return leaf.options.includes(value as string)
    ? null
    : `Must be one of ${leaf.options.map((option) => `${optionTitle(option)} (${option})`).join(", ")}`;
}

function wrongNumber(field: NumberField, value: JsonValue | undefined): string | null {
  if (value === null && field.nullable) return null;
  if (typeof value !== "number") return field.unit === "1" ? "Must be a number" : `Must be a number, in ${field.unit}`;
  if (field.integer && !Number.isInteger(value)) return "Must be a whole number";
  const low = field.exclusiveMinimum ? value <= field.minimum : value < field.minimum;
  return low || value > field.maximum ? `${limitText(field)}; the file has ${valueText(field, value)}` : null;
}

/** Saves an item as a file that any Ridelab can open: a measured road goes with its heights, which another server does not have. */
export async function saveItem(item: Exported, queries: QueryClient): Promise<void> {
  const { version } = await queries.query({ ...schemaQuery, staleTime: "static" });
  const id = roadOf(item);
  const road =
    id === null
      ? null
      : await askFile("get", "/roads/{id}", { path: { id }, query: { format: "csv" } }, (response) => response.text());
  const { name, type, text } = fileOf(item, version, road);
  const address = URL.createObjectURL(new Blob([text], { type }));
  download(address, name);
  URL.revokeObjectURL(address);
}
