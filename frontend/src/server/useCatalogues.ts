/** What pages need to know of the server before they show anything: the form, the strategies and the figures. */

import { useQuery } from "@tanstack/react-query";
import { useMemo } from "react";
import { useComputedColorScheme } from "@mantine/core";
import { isTransient } from "../api/problem";
import { metricsOf } from "./metrics";
import { catalogueQuery, figuresQuery, schemaQuery, strategiesQuery } from "./queries";
import type { Strategy } from "../api/types";
import { printing } from "../lib/printing";
import { useStore } from "../lib/store";

export function useCatalogues() {
  const { data: form, error: noForm } = useQuery(schemaQuery);
  const { data: inLight, error: noStrategies } = useQuery(strategiesQuery);
  const strategies = useSchemeColours(inLight);
  const { data: catalogue, error: noCatalogue } = useQuery(catalogueQuery);
  const { data: templates, error: noTemplates } = useQuery(figuresQuery);
  /** `null` until all are there. */
  const catalogues = useMemo(
    () =>
      form && strategies && catalogue && templates
        ? { form, strategies, catalogue, figures: metricsOf(catalogue, templates) }
        : null,
    [form, strategies, catalogue, templates],
  );
  const fault =
    [noForm, noStrategies, noCatalogue, noTemplates].find((error) => error !== null && !isTransient(error)) ?? null;
  return { catalogues, fault };
}

export type Catalogues = NonNullable<ReturnType<typeof useCatalogues>["catalogues"]>;

/** The same strategies with the colours of light paper, whatever the screen's. */
export function useLightColours(strategies: readonly Strategy[]): readonly Strategy[] {
  const { data } = useQuery(strategiesQuery);
  return useMemo(() => strategies.map((each) => data?.find(({ id }) => id === each.id) ?? each), [strategies, data]);
}

/** The strategies with the colours that stand out on the screen's background; paper is light. */
export function useSchemeColours<List extends readonly Strategy[] | undefined>(strategies: List) {
  const printed = useStore(printing);
  const isDark = useComputedColorScheme("light") === "dark" && !printed;
  return useMemo(
    () => (isDark ? strategies?.map((strategy) => ({ ...strategy, colour: strategy.dark_colour })) : strategies),
    [strategies, isDark],
  );
}
