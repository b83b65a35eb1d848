/** What can be done by a button, a menu, the palette or a key: each action is declared here once. */

import { useEffect, useRef } from "react";
import { createAtom, useSelector } from "@tanstack/react-store";
import { readStored, writeStored } from "../lib/storage";
import type { Pointer } from "../scenario/path";

interface Declared {
  /** What the palette and the list of keys say. */
  readonly label: string;
  /** What its button or menu entry says, where that is shorter. */
  readonly short?: string;
  /** `mod+Z`, `Space`; `mod` is Ctrl, on a Mac the command key. */
  readonly keys?: readonly string[];
  /** What people may look for it by, beside its label. */
  readonly searchWords?: readonly string[];
}

const DECLARED = {
  search: { label: "Search commands and fields", keys: ["mod+K"] },
  help: { label: "Help: tour, manual and keys", short: "Help", keys: ["?"] },
  tour: { label: "Tour of the lab in five steps", short: "Take the tour" },
  undo: { label: "Undo", keys: ["mod+Z"] },
  redo: { label: "Redo", keys: ["mod+shift+Z", "mod+Y"] },
  play: { label: "Play the car, or pause it", keys: ["Space"] },
  instant: {
    label: "Why this force, here? What the controller saw and planned",
    short: "Why this force?",
    keys: ["W"],
  },
  pin: { label: "Pin: keep this result to compare others with it", short: "Pin", keys: ["P"] },
  differences: { label: "Plot differences, or the signals themselves", short: "Plot differences", keys: ["D"] },
  equalSpeed: { label: "Compare at equal speed" },
  solve: {
    label: "How fast may it go? A metric over speed, and its limit",
    keys: ["S"],
    searchWords: ["maximum", "solve", "hump", "bump", "height", "comfort"],
  },
  bump: { label: "Zoom to the bump", short: "Bump", keys: ["B"] },
  whole: { label: "Show the whole run", short: "Whole run", keys: ["A"] },
  axis: { label: "Plots over distance, or over time", keys: ["X"] },
  frequencies: {
    label: "Frequencies: responses, modes and margins",
    searchWords: [
      "natural",
      "frequency",
      "damping",
      "ratio",
      "bode",
      "stability",
      "transfer",
      "function",
      "spectrum",
      "psd",
      "resonance",
    ],
  },
  fuzzy: { label: "Fuzzy speed controller: sets, rules and surface", short: "Edit" },
  library: {
    label: "Library: save, open, import and export",
    short: "Library",
    keys: ["mod+S"],
    searchWords: ["file", "measured", "road", "recorded", "drive", "csv", "crg", "vehicle", "scenario", "requirements"],
  },
  dataSheet: {
    label: "Data sheet: make the half-car of a whole car",
    short: "Data sheet…",
    searchWords: ["total", "mass", "axle", "load", "wheelbase", "center", "natural", "frequency", "damping", "ratio"],
  },
  saveVehicle: { label: "Save the vehicle in the library" },
  paper: { label: "Open the paper’s scenario" },
  reset: { label: "Reset all values to the paper’s", short: "Reset all" },
  copy: { label: "Open a copy to edit" },
  sweep: {
    label: "Sweep: run many variants of this scenario",
    short: "Sweep…",
    searchWords: ["batch", "grid", "parameter", "study", "vary"],
  },
  share: { label: "Share: make a link", short: "Share" },
  report: { label: "Export HTML report", short: "HTML report" },
  png: { label: "Export plots: PNG picture", short: "PNG picture" },
  svg: { label: "Export plots: SVG drawing", short: "SVG drawing" },
  controller: { label: "Export controller (C)" },
  fmu: { label: "Export FMU (Simulink, CarMaker, Modelica)", short: "FMU…" },
  python: { label: "Copy as Python" },
  command: { label: "Copy as command line" },
  curl: { label: "Copy as curl" },
} as const satisfies Readonly<Record<string, Declared>>;

export type ActionId = keyof typeof DECLARED;

export const ACTIONS: Readonly<Record<ActionId, Declared>> = DECLARED;
export const ACTION_IDS = Object.keys(DECLARED) as readonly ActionId[];

const LETTERS_OFF = "ridelab-letter-keys-off";

/** Keys of one letter can be switched off: who speaks to the machine may say them unawares (WCAG 2.1.4). */
export const letterKeys = createAtom(readStored(LETTERS_OFF) !== true);
letterKeys.subscribe((on) => writeStored(LETTERS_OFF, on ? null : true));

/** Whether these keys mean something now. */
export const isKeyOn = (keys: string): boolean => letterKeys.get() || !/^[A-Z]$/.test(keys);

interface Offered {
  /** It can be done now. */
  readonly can: boolean;
  readonly run: { readonly current: () => void };
}

/** Who does each action of the page that is shown. */
const offered = createAtom<ReadonlyMap<ActionId, Offered>>(new Map());

const NOTHING = () => undefined;

/** The part of the page that does an action, while it is shown; `null` while it cannot be done. */
export function useAction(id: ActionId, run: (() => void) | null): void {
  const newest = useRef(NOTHING as () => void);
  useEffect(() => {
    newest.current = run ?? NOTHING;
  });
  const can = run !== null;
  useEffect(() => {
    offered.set((before) => new Map(before).set(id, { can, run: newest }));
    return () => offered.set((before) => new Map([...before].filter(([, by]) => by.run !== newest)));
  }, [id, can]);
}

/** The page that is shown has it, whether or not it can be done now. */
export const isOffered = (id: ActionId): boolean => offered.get().has(id);

export const canRun = (id: ActionId): boolean => offered.get().get(id)?.can === true;

export const runAction = (id: ActionId): void => offered.get().get(id)?.run.current();

/** For a button or a menu entry of it. */
export function useActionButton(id: ActionId) {
  const disabled = !useSelector(offered, (all) => all.get(id)?.can === true);
  const { label, short = label } = ACTIONS[id];
  return { label: short, disabled, onClick: () => runAction(id) };
}

/** Something that the palette finds by its name beside the actions: a page, a strategy, a preset, a field. */
export interface PaletteEntry {
  readonly group: "Pages" | "Files" | "Strategies" | "Library" | "Presets" | "Fields";
  readonly label: string;
  readonly description?: string;
  /** What people may look for it by, beside its label and description. */
  readonly searchWords?: readonly string[] | undefined;
  readonly run: () => void;
}

const lists = new Set<{ readonly current: readonly PaletteEntry[] }>();

export const paletteEntries = (): readonly PaletteEntry[] => [...lists].flatMap(({ current }) => current);

/** These are found while the caller is shown. */
export function usePaletteEntries(own: readonly PaletteEntry[]): void {
  const list = useRef(own);
  useEffect(() => {
    list.current = own;
  });
  useEffect(() => {
    lists.add(list);
    return () => void lists.delete(list);
  }, []);
}

/** A field of the form that somebody looks for; `null` once it has been shown. */
export const revealed = createAtom<Pointer | null>(null);

/** Brings it into sight, ready to be changed. */
export function focusField(pointer: Pointer): void {
  const element = document.querySelector<HTMLElement>(`[data-pointer="${pointer}"]`);
  element?.scrollIntoView({ block: "nearest" });
  const entry = element?.matches("input")
    ? element
    : element?.querySelector<HTMLElement>("input:not([type=hidden]), select");
  entry?.focus({ preventScroll: true });
}
