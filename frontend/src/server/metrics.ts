/** The figures of a run that a batch can be looked at by. */

import type { Catalogue, FigureTemplate, SignalKey } from "../api/types";
import { grouped } from "../lib/order";
import type { ShownUnit } from "../units/quantity";

export interface Metric {
  /** Its column: `bump.body_acceleration.peak`, `comfort.weighted_rms`, `travel_time`. */
  readonly key: string;
  readonly label: string;
  readonly group: string;
  readonly unit: string;
  /** From SI to `unit`. */
  readonly scale: number;
}

/** `Body acceleration, peak, bump`: the whole name, where its group does not stand above it. */
export const fullName = ({ label, group }: Metric) =>
  group.includes(",") ? `${label}, ${group.replace(/^\p{Lu}(?=\p{Ll})/u, (first) => first.toLowerCase())}` : label;

/** Figures to choose from, by group. */
export const optionsOf = (figures: readonly Metric[]) =>
  grouped(
    figures,
    ({ group }) => group,
    (figure) => ({ value: figure.key, label: fullName(figure) }),
  );

type Templates = Readonly<Record<string, FigureTemplate>>;

export function metricsOf(catalogue: Catalogue, templates: Templates): readonly Metric[] {
  const label = (key: string) => catalogue.signals.find((signal) => signal.key === key)?.label ?? key;
  const metrics = catalogue.windows.flatMap((window) =>
    catalogue.statistics.flatMap((statistic) =>
      catalogue.metric_signals.map((signal): Metric => ({
        key: `${window.key}.${signal}.${statistic.key}`,
        label: label(signal),
        group: `${statistic.label}, ${window.label.toLowerCase()}`,
        ...shownUnit(signal, templates, catalogue),
      })),
    ),
  );
  const plain = (list: Catalogue["comfort"], prefix: string, group: string) =>
    list.map(({ key, label: name, unit }): Metric => ({ key: prefix + key, label: name, group, unit, scale: 1 }));
  return [
    ...metrics,
    ...plain(catalogue.comfort, "comfort.", "Comfort"),
    ...plain(catalogue.run_figures, "", "Time and speed"),
    ...plain(catalogue.events, "events.", "Events"),
  ];
}

/** The paper's eight: RMS on the rough road, peak on the bump. */
export function paperMetrics(catalogue: Catalogue): readonly string[] {
  return [
    ...catalogue.paper_signals.map((signal) => `rough_road.${signal}.rms`),
    ...catalogue.paper_signals.map((signal) => `bump.${signal}.peak`),
  ];
}

export const OPENING_METRIC = "bump.body_acceleration.peak";

/** The unit a signal is shown in: the figures say it, the tables follow. */
export function shownUnit(
  signal: SignalKey,
  figures: Readonly<Record<string, FigureTemplate>>,
  catalogue: Catalogue,
): ShownUnit {
  const meta = Object.values(figures).find((figure) => figure.layout.meta.signal === signal)?.layout.meta;
  if (meta) return { unit: meta.unit, scale: meta.scale };
  return { unit: catalogue.signals.find(({ key }) => key === signal)?.unit ?? "1", scale: 1 };
}
