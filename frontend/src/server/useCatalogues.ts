/** What pages need to know of the server before they show anything: the form, the strategies and the figures. */

import { useQuery } from "@tanstack/react-query";
import { useMemo } from "react";
import { isTransient } from "../api/problem";
import { figuresOf } from "./metrics";
import { useSchemeColours } from "./useSchemeColours";
import { catalogueQuery, figuresQuery, schemaQuery, strategiesQuery } from "./queries";

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
        ? { form, strategies, catalogue, figures: figuresOf(catalogue, templates) }
        : null,
    [form, strategies, catalogue, templates],
  );
  const fault =
    [noForm, noStrategies, noCatalogue, noTemplates].find((error) => error !== null && !isTransient(error)) ?? null;
  return { catalogues, fault };
}

export type Catalogues = NonNullable<ReturnType<typeof useCatalogues>["catalogues"]>;
