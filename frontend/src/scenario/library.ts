/** Scenarios, vehicles, measured roads and sets of requirements of one's own, by name. Each has an entry of its own in the browser's storage, so that one tab never overwrites what another has saved. */

import type { JsonObject } from "../api/types";
import { sameValue } from "./path";
import { SCHEMA_VERSION, upgraded } from "./versions";
import { isLike, ownStorage } from "../lib/storage";
import { createAtom, useSelector } from "@tanstack/react-store";

export const KINDS = ["scenario", "vehicle", "road", "requirements"] as const;
export type ItemKind = (typeof KINDS)[number];

export const kindWord = (kind: ItemKind) => (kind === "requirements" ? "set of requirements" : kind);

export interface Item {
  readonly kind: ItemKind;
  readonly name: string;
  /** A whole scenario, its vehicle, the head of a measured road that the server has, or a list of `requirements`. */
  readonly value: JsonObject;
  /** When, as an ISO date. */
  readonly saved: string;
}

/** What the browser has of an item; `version` is the schema's, which core 0.3.0 and before did not store. */
interface Stored extends Pick<Item, "value" | "saved"> {
  readonly version?: number;
}

/** Of an item, or of a pinned variant. */
export const LONGEST_NAME = 80;

const PREFIX = "ridelab-library:";
const REFUSED = "This browser has no room for it, or keeps nothing for this page: export it as a file instead";

export const cleanName = (name: string) => name.trim().slice(0, LONGEST_NAME);

const keyOf = ({ kind, name }: Pick<Item, "kind" | "name">) => `${PREFIX}${kind}:${name}`;

function readItem(key: string, text: string | null): readonly Item[] {
  const [, kind, name] = /^([a-z]+):(.+)$/s.exec(key.slice(PREFIX.length)) ?? [];
  const kindOfItem = KINDS.find((each) => each === kind);
  try {
    const content: unknown = JSON.parse(text ?? "null");
    if (!kindOfItem || name === undefined || !isLike<Stored>({ value: {}, saved: "" }, content)) return [];
    const { value, saved, version = 1 } = content;
    return [{ kind: kindOfItem, name, saved, value: kindOfItem === "scenario" ? upgraded(value, version) : value }];
  } catch {
    return []; // somebody else wrote it
  }
}

/** The newest first. */
function readAll(storage: Storage | null): readonly Item[] {
  const keys = Array.from({ length: storage?.length ?? 0 }, (_, index) => storage?.key(index) ?? "").filter((key) =>
    key.startsWith(PREFIX),
  );
  const items = keys.flatMap((key) => readItem(key, storage?.getItem(key) ?? null));
  return items.sort((one, other) => other.saved.localeCompare(one.saved));
}

/** `now` gives the time of saving. All that change it throw an error where the browser keeps nothing, or the name is taken. */
export function createLibrary(storage: Storage | null, now: () => string = () => new Date().toISOString()) {
  const store = createAtom(readAll(storage));
  const refresh = () => store.set(readAll(storage));
  const write = (item: Item) => {
    try {
      if (storage === null) throw new Error(REFUSED);
      const stored: Stored = { value: item.value, saved: item.saved, version: SCHEMA_VERSION };
      storage.setItem(keyOf(item), JSON.stringify(stored));
    } catch {
      throw new Error(REFUSED);
    }
    refresh();
  };
  const freeName = (kind: ItemKind, name: string) => {
    if (!has(kind, name)) return name;
    const short = name.slice(0, LONGEST_NAME - 5);
    let number = 2;
    while (has(kind, `${short} (${number})`)) number++;
    return `${short} (${number})`;
  };
  const has = (kind: ItemKind, name: string) =>
    readAll(storage).some((item) => item.kind === kind && item.name === name);
  return {
    get: store.get,
    subscribe: store.subscribe,
    refresh,
    /** Replaces what has this name. */
    save: (kind: ItemKind, name: string, value: JsonObject) =>
      write({ kind, name: cleanName(name), value, saved: now() }),
    /** Saves what came from a file, under another name where this one is taken; returns the name. What is there already stays. */
    add: (kind: ItemKind, name: string, value: JsonObject) => {
      const same = readAll(storage).find((item) => item.kind === kind && sameValue(item.value, value));
      if (same) return same.name;
      const free = freeName(kind, cleanName(name));
      write({ kind, name: free, value, saved: now() });
      return free;
    },
    rename: (item: Item, name: string) => {
      const clean = cleanName(name);
      if (clean === "" || clean === item.name) return;
      if (has(item.kind, clean)) throw new Error(`There is a ${kindWord(item.kind)} of this name`);
      write({ ...item, name: clean });
      storage?.removeItem(keyOf(item));
      refresh();
    },
    remove: (item: Item) => {
      storage?.removeItem(keyOf(item));
      refresh();
    },
    /** Undoes `remove`, under another name where this one has been taken since. */
    restore: (item: Item) => write({ ...item, name: freeName(item.kind, item.name) }),
  };
}

/** The library of this browser. */
export const ownLibrary = createLibrary(ownStorage());

/** The gallery's scenario that the address names, `/?gallery=NAME`; `null` where it names none, or it is opened. */
export const galleryEntry = createAtom<string | null>(null);

/** What the open dialog offers to save; `null` while it is closed. */
export const dialog = createAtom<Exclude<ItemKind, "road"> | null>(null);

export function useItems(kind: ItemKind): readonly Item[] {
  return useSelector(ownLibrary).filter((item) => item.kind === kind);
}

/** Its name in this browser's library; a road that is not in it has none. */
export function roadName(id: string): string {
  return ownLibrary.get().find(({ kind, value }) => kind === "road" && value.id === id)?.name ?? "a measured road";
}
