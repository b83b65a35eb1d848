/** The fair table's rows: their parts in words, and filtered. Pure. */

import type { Combination } from "../../api/types";

export interface Filter {
  readonly controller: string;
  readonly speed: string;
  readonly preview: string;
  readonly weights: string;
}

export type FilterName = keyof Filter;

export const ANY = "any";

export const NO_FILTER: Filter = { controller: ANY, speed: ANY, preview: ANY, weights: ANY };

/** What there is to choose among, in words; `null` in a row means there is nothing to choose. */
export const FILTERS: readonly {
  readonly name: FilterName;
  readonly label: string;
  readonly options: readonly (readonly [value: string, label: string])[];
}[] = [
  {
    name: "controller",
    label: "Controller",
    options: [
      ["mpc", "MPC"],
      ["lqr", "LQR"],
      ["passive", "Passive"],
    ],
  },
  {
    name: "speed",
    label: "Speed",
    options: [
      ["constant", "Constant"],
      ["planned", "Planned"],
    ],
  },
  {
    name: "preview",
    label: "Preview",
    options: [
      ["none", "None"],
      ["wheelbase", "Front axle’s"],
      ["lookahead", "Road ahead"],
    ],
  },
  {
    name: "weights",
    label: "Weights",
    options: [
      ["equal", "Equal"],
      ["comfort", "Cruise’s"],
      ["switched", "Switched"],
    ],
  },
];

/** A part of a combination in words. */
export function partOf(row: Combination, name: FilterName): string {
  const value = row[name];
  return FILTERS.find((filter) => filter.name === name)?.options.find(([each]) => each === value)?.[1] ?? "–";
}

export const filtered = (rows: readonly Combination[], filter: Filter) =>
  rows.filter((row) => FILTERS.every(({ name }) => filter[name] === ANY || row[name] === filter[name]));

export const metricKey = ({
  window,
  signal,
  statistic,
}: Pick<Combination["metrics"][number], "window" | "signal" | "statistic">) => `${window}.${signal}.${statistic}`;

/** Options stand in a meaningful order; what has none comes first. */
export const rankOf = (row: Combination, name: FilterName) =>
  FILTERS.find((filter) => filter.name === name)?.options.findIndex(([value]) => value === row[name]);
