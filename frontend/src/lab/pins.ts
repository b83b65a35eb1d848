/** Pinned variants: runs by a name of their own, kept when the tab is closed. */

import { isLike } from "../lib/storage";
import { LONGEST_NAME } from "../scenario/library";
import { createAtom } from "@tanstack/react-store";

export interface Pin {
  readonly name: string;
  readonly run: string;
}

export const MOST_PINS = 8;
const KEY = "ridelab-pins";

const isPin = (value: unknown): value is Pin => isLike<Pin>({ name: "", run: "" }, value);

function parse(text: string | null): readonly Pin[] {
  try {
    const value: unknown = JSON.parse(text ?? "[]");
    return Array.isArray(value) ? value.filter(isPin).slice(0, MOST_PINS) : [];
  } catch {
    return []; // written by another program
  }
}

export function createPins(storage: Storage | null) {
  const store = createAtom<readonly Pin[]>([]);
  /** What the storage held last. */
  let stored: string | null = null;
  const refresh = () => {
    const text = storage?.getItem(KEY) ?? null;
    if (text === stored) return;
    stored = text;
    store.set(parse(text));
  };
  const change = (edit: (pins: readonly Pin[]) => readonly Pin[]) => {
    refresh(); // another tab may have changed them
    const before = store.get();
    const next = edit(before);
    if (next === before) return;
    store.set(next);
    const text = JSON.stringify(next);
    try {
      storage?.setItem(KEY, text);
      stored = text;
    } catch {
      // Full or forbidden: the pins stay until the tab is closed.
    }
  };
  refresh();
  return {
    get: store.get,
    subscribe: store.subscribe,
    /** Reads what another tab has changed. */
    refresh,
    /** Does nothing where the run is pinned already, or there are as many as there may be. */
    add: (pin: Pin) =>
      change((pins) => (pins.length < MOST_PINS && pins.every(({ run }) => run !== pin.run) ? [...pins, pin] : pins)),
    rename: (run: string, name: string) => {
      const trimmed = name.trim().slice(0, LONGEST_NAME);
      if (trimmed !== "") change((pins) => pins.map((pin) => (pin.run === run ? { run, name: trimmed } : pin)));
    },
    remove: (run: string) => change((pins) => pins.filter((pin) => pin.run !== run)),
  };
}

/** What a pin is called until somebody names it: what differs, else the first free number. */
export function defaultName(differs: string, pins: readonly Pin[]): string {
  const taken = (name: string) => pins.some((pin) => pin.name === name);
  const name = differs.slice(0, LONGEST_NAME);
  if (name !== "" && !taken(name)) return name;
  const free = Array.from({ length: MOST_PINS + 1 }, (_, index) => `Variant ${index + 1}`).find(
    (candidate) => !taken(candidate),
  );
  return free ?? "Variant";
}
