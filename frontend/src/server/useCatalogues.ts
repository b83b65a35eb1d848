/** What pages need to know of the server before they show anything, with its words for it; each page's route has it fetched before. */

import { useSuspenseQuery, type QueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import { useComputedColorScheme } from "@mantine/core";
import { metricsOf, shownUnit } from "./metrics";
import { catalogueQuery, figuresQuery, presetsQuery, schemaQuery, strategiesQuery } from "./queries";
import type { Strategy, Catalogue, FigureTemplates } from "../api/types";
import { printing } from "../lib/printing";
import { useSelector } from "@tanstack/react-store";
import type { ShownUnit } from "../units/quantity";
import { prettyUnit } from "../units/format";

/** What is drawn and said of any run. */
export const loadResultWords = (queries: QueryClient) =>
  Promise.all([
    queries.query({ ...strategiesQuery, staleTime: "static" }),
    queries.query({ ...catalogueQuery, staleTime: "static" }),
    queries.query({ ...figuresQuery, staleTime: "static" }),
  ]);

/** The same with what scenarios are made of. */
export const loadCatalogues = (queries: QueryClient) =>
  Promise.all([
    loadResultWords(queries),
    queries.query({ ...schemaQuery, staleTime: "static" }),
    queries.query({ ...presetsQuery, staleTime: "static" }),
  ]);

export const useForm = () => useSuspenseQuery(schemaQuery).data;
export const usePresets = () => useSuspenseQuery(presetsQuery).data;
export const useStrategies = () => useSuspenseQuery(strategiesQuery).data;
export const useCatalogue = () => useSuspenseQuery(catalogueQuery).data;
export const useFigures = () => useSuspenseQuery(figuresQuery).data;

export function useCatalogues() {
  const [form, catalogue, templates] = [useForm(), useCatalogue(), useFigures()];
  const strategies = useSchemeColours(useStrategies());
  return useMemo(
    () => ({ form, strategies, catalogue, figures: metricsOf(catalogue, templates) }),
    [form, strategies, catalogue, templates],
  );
}

export type Catalogues = ReturnType<typeof useCatalogues>;

/** The strategies with the colours that stand out on the screen's background; paper is light. */
export function useSchemeColours(strategies: readonly Strategy[]): readonly Strategy[] {
  const printed = useSelector(printing);
  const isDark = useComputedColorScheme("light") === "dark" && !printed;
  return useMemo(
    () => (isDark ? strategies.map((strategy) => ({ ...strategy, colour: strategy.dark_colour })) : strategies),
    [strategies, isDark],
  );
}

function labelsOf(catalogue: Catalogue, strategies: readonly Strategy[], templates: FigureTemplates) {
  const label = (list: Catalogue["signals"], key: string) => list.find((entry) => entry.key === key)?.label ?? key;
  return {
    catalogue,
    strategy: (id: string) => strategies.find((strategy) => strategy.id === id)?.label ?? id,
    signal: (key: string) => label(catalogue.signals, key),
    /** The unit a signal is shown in, ready to read, and the factor to it. */
    unit: (key: string): ShownUnit => {
      const { unit, scale } = shownUnit(key, templates, catalogue);
      return { unit: prettyUnit(unit), scale };
    },
    /** `RMS, rough road`. */
    view: ({ window, statistic }: { readonly window: string; readonly statistic: string }) =>
      `${label(catalogue.statistics, statistic)}, ${label(catalogue.windows, window).toLowerCase()}`,
    /** A comfort or run figure's label with its unit. */
    figure: (key: string) => {
      const quantity = [...catalogue.comfort, ...catalogue.run_figures].find((entry) => entry.key === key);
      return quantity ? `${quantity.label} [${prettyUnit(quantity.unit)}]` : key;
    },
  };
}

export type Labels = ReturnType<typeof labelsOf>;

export function useLabels(): Labels {
  const [catalogue, strategies, templates] = [useCatalogue(), useStrategies(), useFigures()];
  return useMemo(() => labelsOf(catalogue, strategies, templates), [catalogue, strategies, templates]);
}
