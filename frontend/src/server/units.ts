/** The unit a signal is shown in: the figures say it, the tables follow. */

import type { Catalogue, FigureTemplate, SignalKey } from "../api/types";
import type { ShownUnit } from "../units/quantity";

export function shownUnit(
  signal: SignalKey,
  figures: Readonly<Record<string, FigureTemplate>>,
  catalogue: Catalogue,
): ShownUnit {
  const meta = Object.values(figures).find((figure) => figure.layout.meta.signal === signal)?.layout.meta;
  if (meta) return { unit: meta.unit, scale: meta.scale };
  return { unit: catalogue.signals.find(({ key }) => key === signal)?.unit ?? "1", scale: 1 };
}
