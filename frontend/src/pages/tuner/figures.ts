/** What a tuning's numbers are called and shown in: objectives, limits and plain figures. */

import { useMemo } from "react";
import type { Limit, Objective, Tuning } from "../../api/types";
import { fullName, type Metric } from "../../server/metrics";
import { useCatalogues, type Catalogues } from "../../server/useCatalogues";

export interface ShownNumber {
  readonly label: string;
  readonly unit: string;
  /** From SI to `unit`. */
  readonly scale: number;
}

const ofFigure = (name: string, figures: readonly Metric[]): ShownNumber | null => {
  const figure = figures.find(({ key }) => key === name);
  return figure ? { label: fullName(figure), unit: figure.unit, scale: figure.scale } : null;
};

export function ofObjective({ figure, label, unit }: Objective, figures: readonly Metric[]): ShownNumber {
  return (figure === null ? null : ofFigure(figure, figures)) ?? { label, unit, scale: 1 };
}

export function ofLimit({ figure, label, unit }: Limit, figures: readonly Metric[]): ShownNumber {
  return ofFigure(figure, figures) ?? { label, unit, scale: 1 };
}

/** A column of the comparison: `objectives.0`, `limits.1`, or a figure's name. */
export function ofKey(
  key: string,
  { objectives, limits }: Pick<Tuning, "objectives" | "limits">,
  figures: readonly Metric[],
): ShownNumber {
  const [, list, index] = /^(objectives|limits)\.(\d+)$/.exec(key) ?? [];
  const objective = list === "objectives" ? objectives[Number(index)] : undefined;
  const limit = list === "limits" ? limits[Number(index)] : undefined;
  if (objective) return ofObjective(objective, figures);
  if (limit) return ofLimit(limit, figures);
  return ofFigure(key, figures) ?? { label: key, unit: "1", scale: 1 };
}

/** What the tuner's pages need of the server: as figures only those that are numbers. */
export function useNumericCatalogues(): Catalogues {
  const catalogues = useCatalogues();
  return useMemo(
    () => ({ ...catalogues, figures: catalogues.figures.filter(({ key }) => key !== "events.target_reached") }),
    [catalogues],
  );
}
