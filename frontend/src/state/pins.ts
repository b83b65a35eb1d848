/** Pinned variants: runs by a name of their own, kept when the tab is closed. */

import { createStore, type Store } from "./store";

export interface Pin {
  readonly name: string;
  readonly run: string;
}

export interface Pins extends Pick<Store<readonly Pin[]>, "get" | "subscribe"> {
  /** Does nothing where the run is pinned already, or there are as many as there may be. */
  readonly add: (pin: Pin) => void;
  readonly rename: (run: string, name: string) => void;
  readonly remove: (run: string) => void;
}

export const MOST_PINS = 8;
export const LONGEST_NAME = 80;
const KEY = "ridelab-pins";

const isPin = (value: unknown): value is Pin =>
  typeof value === "object" && value !== null && "name" in value && typeof value.name === "string" && "run" in value && typeof value.run === "string";

function read(storage: Storage | null): readonly Pin[] {
  try {
    const value: unknown = JSON.parse(storage?.getItem(KEY) ?? "[]");
    return Array.isArray(value) ? value.filter(isPin).slice(0, MOST_PINS) : [];
  } catch {
    return []; // written by somebody else, or the browser gives no storage
  }
}

function write(storage: Storage | null, pins: readonly Pin[]): void {
  try {
    storage?.setItem(KEY, JSON.stringify(pins));
  } catch {
    // Full or forbidden: the pins stay until the tab is closed.
  }
}

export function createPins(storage: Storage | null): Pins {
  const store = createStore<readonly Pin[]>(read(storage));
  const change = (next: readonly Pin[]) => {
    store.set(next);
    write(storage, next);
  };
  return {
    get: store.get,
    subscribe: store.subscribe,
    add: (pin) => {
      const pins = store.get();
      if (pins.length < MOST_PINS && pins.every(({ run }) => run !== pin.run)) change([...pins, pin]);
    },
    rename: (run, name) => {
      const trimmed = name.trim().slice(0, LONGEST_NAME);
      if (trimmed !== "") change(store.get().map((pin) => (pin.run === run ? { run, name: trimmed } : pin)));
    },
    remove: (run) => change(store.get().filter((pin) => pin.run !== run)),
  };
}

/** What a pin is called until somebody names it: what differs, else the first free number. */
export function defaultName(differs: string, pins: readonly Pin[]): string {
  const taken = (name: string) => pins.some((pin) => pin.name === name);
  const name = differs.slice(0, LONGEST_NAME);
  if (name !== "" && !taken(name)) return name;
  const free = Array.from({ length: MOST_PINS + 1 }, (_, index) => `Variant ${index + 1}`).find((candidate) => !taken(candidate));
  return free ?? "Variant";
}
