/** What the tuner's pages need of the server: as figures only those that are numbers. */

import { useMemo } from "react";
import { useCatalogues, type Catalogues } from "../../server/useCatalogues";

export function useNumericCatalogues(): ReturnType<typeof useCatalogues> {
  const { catalogues, fault } = useCatalogues();
  const numeric = useMemo(
    (): Catalogues | null =>
      catalogues && { ...catalogues, figures: catalogues.figures.filter(({ key }) => key !== "events.target_reached") },
    [catalogues],
  );
  return { catalogues: numeric, fault };
}
