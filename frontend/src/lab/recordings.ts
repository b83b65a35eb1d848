/** Recorded drives, which stand beside the simulated strategies: what they are called here, and how they are drawn. */

import { createAtom, useSelector } from "@tanstack/react-store";
import { useMemo } from "react";
import { mapped } from "../api/decode";
import type { FigureTemplate, FigureTemplates, Strategy, StrategyId } from "../api/types";
import { isRecording } from "../lib/recording";
import { isLike, readStored, writeStored } from "../lib/storage";
import { useFigures, useStrategies } from "../server/useCatalogues";
import { useLab } from "./context";
import type { LabState } from "./labState";

/** A recording that was opened in this browser, the newest first. */
interface Named {
  readonly id: StrategyId;
  readonly name: string;
}

const [STORED, MOST] = ["ridelab-recordings", 12];

function read(): readonly Named[] {
  const stored = readStored(STORED);
  return isLike<readonly Named[]>([{ id: "", name: "" }], stored) ? stored : [];
}

const named = createAtom<readonly Named[]>(read());

export function nameRecording(id: StrategyId, name: string): void {
  named.set((all) => [{ id, name }, ...all.filter((each) => each.id !== id)].slice(0, MOST));
  writeStored(STORED, named.get());
}

/** As backend/runs/figures.py draws them. */
const STYLES: readonly (readonly [colour: string, dark: string, dash: string])[] = [
  ["#111827", "#F9FAFB", "solid"],
  ["#7A1F5C", "#FFB3E6", "10px,2px"],
  ["#14532D", "#A7F3B0", "4px,2px"],
];

/** What controlled it is not known: it resolves as little as the strategy that varies most, as the service has it. */
function leastResolution(strategies: readonly Strategy[]): Strategy["one_road_resolution"] {
  const every = strategies.flatMap((strategy) => Object.entries(strategy.one_road_resolution));
  const of = (statistic: string) => every.flatMap(([key, percent]) => (key === statistic ? [percent] : []));
  return Object.fromEntries(every.map(([statistic]) => [statistic, Math.max(...of(statistic))]));
}

function strategyOf(
  id: StrategyId,
  name: string | undefined,
  like: Strategy,
  one_road_resolution: Strategy["one_road_resolution"],
): Strategy {
  const key = id.replace(/^recording:/, "");
  const sum = Array.from(key, (letter) => letter.charCodeAt(0)).reduce((total, code) => total + code, 0);
  const [colour = "", dark_colour = "", dash = ""] = STYLES[sum % STYLES.length] ?? [];
  const label = name ?? `Recording ${key.slice(0, 6)}`;
  const description = "A recorded drive, placed on this road by its likeness to a simulated one.";
  return { ...like, id, label, description, colour, dark_colour, dash, reads: [], reads_when: [], one_road_resolution };
}

const inUse = ({ strategies, shown }: LabState) =>
  [...strategies, ...Object.keys(shown?.summaries ?? {})].filter(isRecording).join();

/** Every strategy there is, then the recordings of this browser and of what is shown. */
export function useLabStrategies(): readonly Strategy[] {
  const [strategies, own, used] = [useStrategies(), useSelector(named), useLab(inUse)];
  return useMemo(() => {
    const like = strategies.find(({ id }) => id === "passive") ?? strategies[0];
    const ids = [...new Set([...own.map(({ id }) => id), ...used.split(",").filter(Boolean)])];
    const resolution = leastResolution(strategies);
    const nameOf = (id: StrategyId) => own.find((each) => each.id === id)?.name;
    const recorded = like ? ids.map((id) => strategyOf(id, nameOf(id), like, resolution)) : [];
    return [...strategies, ...recorded];
  }, [strategies, own, used]);
}

/** The figures with a curve for each recording among the strategies. */
export function useLabFigures(strategies: readonly Strategy[]): FigureTemplates {
  const templates = useFigures();
  return useMemo(() => withRecordings(templates, strategies), [templates, strategies]);
}

function withRecordings(templates: FigureTemplates, strategies: readonly Strategy[]): FigureTemplates {
  const recorded = strategies.filter(({ id }) => isRecording(id));
  const added = (template: FigureTemplate): FigureTemplate => {
    const { signal } = template.layout.meta;
    const traces = recorded.map(({ id, label, dash }) => ({
      ...template.data[0],
      name: label,
      line: { ...template.data[0]?.line, dash },
      meta: { strategy: id, signal },
    }));
    return { ...template, data: [...template.data, ...traces] };
  };
  if (recorded.length === 0) return templates;
  return mapped(templates, added);
}
