/** Opens items and files in the lab, as an edit that can be undone; what came from a file is in the library too. */

import { useQuery, useQueryClient } from "@tanstack/react-query";
import { api } from "../api/client";
import { ask } from "../api/http";
import { ApiProblem } from "../api/problem";
import type { CreatedRoad, JsonObject, JsonValue, Scenario } from "../api/types";
import { completed } from "../editor/diff";
import { onRoad } from "../editor/measuredRoad";
import { sameValue, setAt, type Pointer } from "../editor/path";
import type { Group } from "../editor/schema";
import { DEFAULT_VIEW } from "../state/address";
import { useEdit, useReadOnly } from "../state/context";
import { presetsQuery, schemaQuery, vehiclesQuery } from "../state/queries";
import { createStore } from "../state/store";
import { dotted } from "../sweep/fields";
import { readFile } from "./files";
import { KINDS, type Item, type Kind } from "./library";
import { dialog, ownLibrary } from "./ownLibrary";

export interface Notice {
  readonly lines: readonly string[];
  readonly isWrong: boolean;
  /** It stands until this is no longer the scenario. */
  readonly scenario: Scenario;
}

/** What the library has done last. */
export const notice = createStore<Notice | null>(null);

type Content = Pick<Item, "kind" | "value">;

/** The edited scenario with an item in place of its own. */
export function withItem(scenario: Scenario, { kind, value }: Content, form: Group): Scenario {
  if (kind === "scenario") return completed(form, value);
  // A road's value is what the server said of it when it was uploaded.
  if (kind === "road") return onRoad(scenario, value as unknown as CreatedRoad);
  return completed(form, setAt(scenario, "/vehicle", value));
}

export function useOpenItem(): (item: Content) => void {
  const edit = useEdit();
  const form = useQuery(schemaQuery).data;
  return (item) => {
    if (!form) return;
    const next = withItem(edit.newest(), item, form);
    if (!sameValue(next, edit.newest())) edit.commit(next);
  };
}

interface Opened extends Content {
  readonly name: string;
  readonly warnings: readonly string[];
}

const LONGEST = 4 * 1024 * 1024;

/** The content of a file as the server understands it: complete, in SI units, and within every limit. */
async function upload(file: File, form: Group, wanted: Kind | undefined): Promise<Opened> {
  if (file.size > LONGEST) throw new Error("A file may have 4 MiB");
  const parts = form.members.map(({ pointer }) => dotted(pointer));
  const content = readFile(file.name, await file.text(), parts);
  const stem = file.name.replace(/\.\w+$/, "") || "File";
  if (content.kind === "road") {
    const { warnings, ...road } = await ask("post", "/roads", { body: content.csv });
    return { kind: "road", name: stem, value: road as unknown as JsonObject, warnings };
  }
  if (wanted === "vehicle" && content.kind === "scenario" && !("vehicle" in content.value)) throw new Error("This file has no vehicle");
  const asked = content.kind === "vehicle" ? { vehicle: content.value } : content.value;
  const { scenario } = await api.createRun(asked, [DEFAULT_VIEW.baseline]);
  const kind = wanted === "vehicle" ? wanted : content.kind;
  return { kind, name: content.label ?? stem, value: kind === "vehicle" ? (scenario.vehicle as JsonObject) : scenario, warnings: [] };
}

function problemText(error: unknown): string {
  if (error instanceof ApiProblem && error.errors.length > 0) {
    return error.errors.map(({ pointer, message }) => [dotted(pointer.replace(/^\/scenario/, "") as Pointer), message].filter(Boolean).join(": ")).join(". ");
  }
  return error instanceof Error ? error.message : String(error);
}

/** Adds it to the library, except where the server has it by a name; returns what to say of it. */
function addToLibrary({ kind, name, value }: Opened, known: readonly (JsonValue | undefined)[]): string {
  if (known.some((each) => sameValue(each, value))) return `The ${kind} “${name}” is opened.`;
  try {
    return `The ${kind} “${ownLibrary.add(kind, name, value)}” is opened, and in the library.`;
  } catch (error) {
    return `The ${kind} “${name}” is opened, but not in the library. ${problemText(error)}.`;
  }
}

/** `wanted` is the part to take from a file that has more. */
export function useOpenFiles(): (files: readonly File[], wanted?: Kind) => Promise<void> {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const queries = useQueryClient();
  const say = (lines: readonly string[], isWrong = false) => notice.set({ lines, isWrong, scenario: edit.newest() });
  return async (files, wanted) => {
    dialog.set(null);
    if (readOnly) {
      say(["A shared result cannot be changed: open a copy to edit first."], true);
      return;
    }
    say([`Opening ${files.map(({ name }) => name).join(", ")}`]);
    const answers = await Promise.all([
      queries.query({ ...schemaQuery, staleTime: "static" }),
      queries.query({ ...presetsQuery, staleTime: "static" }),
      queries.query({ ...vehiclesQuery, staleTime: "static" }),
    ]).catch((error: unknown) => say([problemText(error)], true));
    if (!answers) return;
    const [form, presets, vehicles] = answers;
    const known = [...presets.map(({ scenario }) => scenario), ...vehicles.map(({ vehicle }) => completed(form, { vehicle }).vehicle)];
    const wrong: string[] = [];
    const opened: Opened[] = [];
    for (const file of files) {
      try {
        opened.push(await upload(file, form, wanted));
      } catch (error) {
        wrong.push(`${file.name}: ${problemText(error)}`);
      }
    }
    // A vehicle and a road belong into the scenario that came with them.
    opened.sort((one, other) => KINDS.indexOf(one.kind) - KINDS.indexOf(other.kind));
    const next = opened.reduce((scenario, content) => withItem(scenario, content, form), edit.newest());
    if (!sameValue(next, edit.newest())) edit.commit(next);
    say([...wrong, ...opened.flatMap((content) => [addToLibrary(content, known), ...content.warnings])], wrong.length > 0);
  };
}
