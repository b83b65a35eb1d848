/** The same scenario computed twice: which figures differ, the largest change first. */

import type { Catalogue, FigureTemplate, Run, StrategyId, Summary } from "../../api/types";
import { shownUnit } from "../../server/units";

export type Figure = number | boolean | null;

export interface Difference {
  readonly strategy: StrategyId;
  readonly metric: string;
  readonly unit: string;
  readonly then: Figure;
  readonly now: Figure;
  /** Relative to the larger of both, 0 to 2; infinite where one of them is not a number. */
  readonly size: number;
}

export interface Comparison {
  readonly differences: readonly Difference[];
  /** How many figures were compared. */
  readonly compared: number;
  /** Strategies that failed then or now, in words. */
  readonly failed: readonly string[];
}

interface Named {
  readonly metric: string;
  readonly unit: string;
  readonly value: Figure;
  /** From SI to `unit`. */
  readonly scale: number;
}

type Figures = Readonly<Record<string, FigureTemplate>>;

/** Every figure of a result in the unit the page shows it in. */
function figuresOf(summary: Summary, catalogue: Catalogue, templates: Figures): readonly Named[] {
  const name = (list: Catalogue["signals"], key: string) => list.find((entry) => entry.key === key)?.label ?? key;
  const metrics = Object.entries(summary.metrics).flatMap(([window, signals]) =>
    Object.entries(signals).flatMap(([signal, statistics]) => {
      const { unit, scale } = shownUnit(signal, templates, catalogue);
      return Object.entries(statistics).map(([statistic, value]): Named => {
        const place = `${name(catalogue.statistics, statistic)}, ${name(catalogue.windows, window).toLowerCase()}`;
        return {
          metric: `${name(catalogue.signals, signal)}: ${place}`,
          unit,
          value: typeof value === "number" ? value * scale : null,
          scale,
        };
      });
    }),
  );
  const named = (list: Catalogue["comfort"], read: (key: string) => Figure | undefined) =>
    list.map(({ key, label, unit }): Named => ({ metric: label, unit, value: read(key) ?? null, scale: 1 }));
  return [
    ...metrics,
    ...named(catalogue.comfort, (key) => summary.comfort[key]),
    ...named(catalogue.run_figures, (key) => (key === "travel_time" ? summary.travel_time : summary.arrival_speed_kmh)),
    ...named(catalogue.events, (key) => summary.events[key]),
  ];
}

/** Room for rounding, as `ridelab compare` leaves it: a part of the value, and an amount in SI units. */
const [RELATIVE, ABSOLUTE] = [1e-6, 1e-9];

function sizeOf({ value: then, scale }: Named, now: Figure): number {
  if (then === now) return 0;
  if (typeof then !== "number" || typeof now !== "number") return Infinity;
  if (Math.abs(now - then) <= Math.max(ABSOLUTE * scale, RELATIVE * Math.abs(then))) return 0;
  return Math.abs(now - then) / Math.max(Math.abs(then), Math.abs(now));
}

export function compareRuns(then: Run, now: Run, catalogue: Catalogue, templates: Figures): Comparison {
  const differences: Difference[] = [];
  const failed: string[] = [];
  let compared = 0;
  for (const [strategy, before] of Object.entries(then.strategies)) {
    const after = now.strategies[strategy];
    if (after === undefined) continue;
    if (before.status !== "ok" || after.status !== "ok") {
      const say = (entry: typeof before) => (entry.status === "ok" ? "computed" : `failed (${entry.reason})`);
      failed.push(`${strategy}: ${say(before)} then, ${say(after)} now`);
      continue;
    }
    const news = new Map(figuresOf(after, catalogue, templates).map(({ metric, value }) => [metric, value]));
    for (const figure of figuresOf(before, catalogue, templates)) {
      const { metric, unit, value } = figure;
      const current = news.get(metric) ?? null;
      compared += 1;
      const size = sizeOf(figure, current);
      if (size > 0) differences.push({ strategy, metric, unit, then: value, now: current, size });
    }
  }
  return { differences: differences.sort((a, b) => b.size - a.size), compared, failed };
}
