/** Turns the scenario's JSON Schema into the fields of the form. Labels, units and limits come from there alone. */

import type { JsonObject, JsonValue } from "../api/types";
import { shownIn, type ShownUnit } from "../units/quantity";
import { child, isObject, type Pointer } from "./path";

interface Base {
  readonly pointer: Pointer;
  readonly title: string;
  readonly description: string;
  /** The paper's value. */
  readonly paperValue: JsonValue;
  /** What stands beside the title, where a value may be misunderstood without it. */
  readonly note?: string;
  /** Words, and phrases, that people may look for it by beside its title and help. */
  readonly searchWords?: readonly string[];
}

export interface NumberField extends Base {
  readonly kind: "number";
  readonly integer: boolean;
  readonly nullable: boolean;
  readonly unit: string;
  readonly minimum: number;
  readonly maximum: number;
  readonly exclusiveMinimum: boolean;
  readonly soft: readonly [number, number];
  /** The unit people think of it in; values stay in `unit`. */
  readonly shown: ShownUnit;
}

/** One of several names, or of off and on. */
export interface ChoiceField extends Base {
  readonly kind: "choice";
  readonly options: readonly string[];
  readonly onOff: boolean;
}

/** A name that something else gives, or none: a measured road's id. */
export interface TextField extends Base {
  readonly kind: "text";
}

/** Data that files and scripts set, or none: a rule base of the fuzzy controller. It is kept, and has no control here. */
export interface DataField extends Base {
  readonly kind: "data";
}

export const optionOf = (value: JsonValue | undefined) => (typeof value === "boolean" ? String(value) : text(value));

export const optionValue = (field: ChoiceField, option: string): string | boolean =>
  field.onOff ? option === "true" : option;

export function optionTitle(option: string): string {
  if (option === "true") return "On";
  return option === "false" ? "Off" : humanise(option);
}

export interface VectorField extends Base {
  readonly kind: "vector";
  readonly items: readonly NumberField[];
}

export interface Group {
  readonly kind: "group";
  readonly pointer: Pointer;
  readonly title: string;
  readonly description: string;
  readonly members: readonly Member[];
}

export type Field = NumberField | ChoiceField | TextField | DataField | VectorField;
export type Member = Field | Group;

const text = (value: unknown) => (typeof value === "string" ? value : "");
const number = (value: unknown): number | undefined => (typeof value === "number" ? value : undefined);
const list = (value: unknown): readonly JsonValue[] => (Array.isArray(value) ? (value as readonly JsonValue[]) : []);

/** `cg_to_front` → `Cg to front`: for names that have no title of their own. */
export function humanise(name: string): string {
  const words = name.replace(/_/g, " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

function softRange(node: JsonObject, minimum: number, maximum: number): readonly [number, number] {
  const [low, high] = list(node.soft_range).map(number);
  return [low ?? minimum, high ?? maximum];
}

class Reader {
  readonly #definitions: JsonObject;

  constructor(schema: JsonObject) {
    this.#definitions = isObject(schema.$defs) ? schema.$defs : {};
  }

  /** The node with what it refers to; its own title and default win. */
  resolve(node: JsonObject): JsonObject {
    const reference = text(node.$ref) || text(list(node.allOf).find(isObject)?.$ref);
    const target = this.#definitions[reference.replace("#/$defs/", "")];
    if (reference === "" || !isObject(target)) return node;
    return { ...this.resolve(target), ...node };
  }

  group(node: JsonObject, pointer: Pointer | "", title: string, paperValues: JsonValue): Group {
    const properties = isObject(node.properties) ? node.properties : {};
    const members = Object.entries(properties).flatMap(([name, raw]) => {
      const member = isObject(raw) ? this.#member(raw, child(pointer, name), name, paperValues) : null;
      return member === null ? [] : [member];
    });
    return {
      kind: "group",
      pointer: pointer === "" ? "/" : pointer,
      title,
      description: text(node.description),
      members,
    };
  }

  #member(raw: JsonObject, pointer: Pointer, name: string, parent: JsonValue): Member | null {
    const node = this.resolve(raw);
    const parentDefault = isObject(parent) ? parent[name] : undefined;
    const paperValue = parentDefault ?? node.default ?? null;
    const base: Base = {
      pointer,
      title: text(raw.title) || (node.properties ? humanise(name) : text(node.title) || humanise(name)),
      description: text(node.description),
      paperValue,
      note: text(node.note),
      searchWords: list(node.search_words).map(text),
    };
    if (isObject(node.properties)) return this.group(node, pointer, base.title, paperValue);
    if (Array.isArray(node.enum))
      return { ...base, kind: "choice", options: list(node.enum).map(String), onOff: false };
    if (node.type === "boolean") return { ...base, kind: "choice", options: ["false", "true"], onOff: true };
    if (Array.isArray(node.prefixItems)) return this.#vector(node, base);
    const variants = list(node.anyOf).filter(isObject);
    if (variants.some((variant) => variant.type === "string" && !variant.enum)) return { ...base, kind: "text" };
    if (variants.some((variant) => variant.type === "array" || text(variant.$ref) !== ""))
      return { ...base, kind: "data" };
    return this.#number(node, base);
  }

  #vector(node: JsonObject, base: Base): VectorField {
    const titles = list(node.item_titles).map(text);
    const items = list(node.prefixItems).flatMap((raw, index): NumberField[] => {
      const item = isObject(raw) ? { ...raw, unit: node.unit ?? "1", soft_range: node.soft_range ?? null } : null;
      if (item === null) return [];
      const title = titles[index] ?? String(index + 1);
      const paperValue = list(base.paperValue)[index] ?? null;
      const field = this.#number(item, {
        pointer: child(base.pointer, index),
        title,
        description: "",
        paperValue,
        searchWords: base.searchWords ?? [],
      });
      return field ? [field] : [];
    });
    return { ...base, kind: "vector", items };
  }

  #number(node: JsonObject, base: Base): NumberField | null {
    const variants = list(node.anyOf).filter(isObject);
    const body = variants.find((variant) => variant.type === "number" || variant.type === "integer") ?? node;
    if (body.type !== "number" && body.type !== "integer") return null;
    const minimum = number(body.minimum) ?? number(body.exclusiveMinimum) ?? -Infinity;
    const maximum = number(body.maximum) ?? Infinity;
    const unit = text(node.unit) || "1";
    return {
      ...base,
      kind: "number",
      integer: body.type === "integer",
      nullable: variants.some((variant) => variant.type === "null"),
      unit,
      shown: shownIn(unit, text(node.shown_unit) || unit),
      minimum,
      maximum,
      exclusiveMinimum: body.minimum === undefined && body.exclusiveMinimum !== undefined,
      soft: softRange(node, minimum, maximum),
    };
  }
}

export interface ScenarioSchema extends Group {
  /** What a whole car's data sheet says. */
  readonly dataSheet: Group;
  /** Of the schema: files of a newer one cannot be read. */
  readonly version: number;
}

/** The whole form, as the schema orders it. */
export function readSchema(schema: JsonObject): ScenarioSchema {
  const sheet = isObject(schema.data_sheet) ? schema.data_sheet : {};
  return {
    ...new Reader(schema).group(schema, "", "Scenario", {}),
    dataSheet: new Reader(sheet).group(sheet, "", "Data sheet", {}),
    version: number(schema.schema_version) ?? 1,
  };
}

/** Every field under a member, groups flattened, vectors whole. */
export function fieldsOf(member: Member): readonly Field[] {
  return member.kind === "group" ? member.members.flatMap(fieldsOf) : [member];
}

export function findMember(root: Group, pointer: Pointer): Member | undefined {
  for (const member of root.members) {
    if (member.pointer === pointer) return member;
    if (member.kind === "group" && pointer.startsWith(`${member.pointer}/`)) return findMember(member, pointer);
  }
  return undefined;
}
