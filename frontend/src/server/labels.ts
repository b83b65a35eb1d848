/** What strategies, signals and windows are called and shown in: the catalogue's words, in one hand. */

import { useMemo } from "react";
import type { Catalogue, FigureTemplates, Strategy } from "../api/types";
import { shownUnit } from "./metrics";
import { useCatalogue, useFigures, useStrategies } from "./useCatalogues";
import type { ShownUnit } from "../units/quantity";
import { prettyUnit } from "../units/format";

export interface Labels {
  readonly catalogue: Catalogue;
  readonly strategy: (id: string) => string;
  readonly signal: (key: string) => string;
  /** The unit a signal is shown in, ready to read, and the factor to it. */
  readonly unit: (key: string) => ShownUnit;
  /** `RMS, rough road`. */
  readonly view: (view: { readonly window: string; readonly statistic: string }) => string;
  /** A comfort or run figure's label with its unit. */
  readonly figure: (key: string) => string;
}

function labelsOf(catalogue: Catalogue, strategies: readonly Strategy[], templates: FigureTemplates): Labels {
  const label = (list: Catalogue["signals"], key: string) => list.find((entry) => entry.key === key)?.label ?? key;
  return {
    catalogue,
    strategy: (id) => strategies.find((strategy) => strategy.id === id)?.label ?? id,
    signal: (key) => label(catalogue.signals, key),
    unit: (key) => {
      const { unit, scale } = shownUnit(key, templates, catalogue);
      return { unit: prettyUnit(unit), scale };
    },
    view: ({ window, statistic }) =>
      `${label(catalogue.statistics, statistic)}, ${label(catalogue.windows, window).toLowerCase()}`,
    figure: (key) => {
      const quantity = [...catalogue.comfort, ...catalogue.run_figures].find((entry) => entry.key === key);
      return quantity ? `${quantity.label} [${prettyUnit(quantity.unit)}]` : key;
    },
  };
}

export function useLabels(): Labels {
  const [catalogue, strategies, templates] = [useCatalogue(), useStrategies(), useFigures()];
  return useMemo(() => labelsOf(catalogue, strategies, templates), [catalogue, strategies, templates]);
}
