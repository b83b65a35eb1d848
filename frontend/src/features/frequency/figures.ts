/** Figures over frequency, on a logarithmic axis. Pure. */

import type { FrequencyAnswer, Strategy } from "../../api/types";
import { marked, panelLayout, verticalRange } from "../../plots/figure";
import type { Palette } from "../../plots/palettes";
import type { PanelFigure, PlotTrace } from "../../plots/plotly";

export interface FrequencyFigure {
  readonly title: string;
  readonly unit: string;
  readonly figure: PanelFigure;
}

const PASSIVE = "passive";
const MARKS = [0.5, 1, 2, 5, 10, 20];
const [Y_TICKS, LEAST_DB, LEAST_DEGREES] = [6, 6, 30];
const BAND_FILL = "rgba(120, 135, 142, 0.13)";

export const toDecibels = (ratio: number): number => 20 * Math.log10(Math.max(ratio, Number.MIN_VALUE));
const toDegrees = (phase: number): number => (180 / Math.PI) * phase;

type Values = readonly number[] | undefined;

/** The figures of one signal: gain and phase, gain against passive, and the spectrum on the scenario's road. */
export function frequencyFigures(
  { frequency, bands, strategies: results }: FrequencyAnswer,
  strategies: readonly Strategy[],
  signal: string,
  palette: Palette,
): readonly FrequencyFigure[] {
  const across = frequency.map(Math.log10);
  const range = [across[0] ?? 0, across.at(-1) ?? 1] as const;
  const inRange = MARKS.filter((mark) => Math.log10(mark) >= range[0] && Math.log10(mark) <= range[1]);
  const xaxis = {
    range,
    tickvals: inRange.map(Math.log10),
    ticktext: inRange.map((mark, index) => `${String(mark)}${index === inRange.length - 1 ? " Hz" : ""}`),
  };
  const shapes = bands.map(([low = 1, high = 1]) => ({
    ...{ type: "rect", xref: "x", yref: "paper", x0: Math.log10(low), x1: Math.log10(high), y0: 0, y1: 1 },
    ...{ layer: "below", line: { width: 0 }, fillcolor: BAND_FILL },
  }));
  const figure = (valuesOf: (id: string) => Values, least: number): PanelFigure => {
    const data = strategies.flatMap(({ id, colour, dash, label }): readonly PlotTrace[] => {
      const values = valuesOf(id);
      if (!values) return [];
      const line = { color: colour, width: 1.8, dash };
      const [x, y] = [Float32Array.from(across), Float32Array.from(values)];
      return [{ type: "scatter", mode: "lines", name: label, x, y, line }];
    });
    return { data, layout: panelLayout(palette, xaxis, marked(verticalRange(data, [], 0, least), Y_TICKS), shapes) };
  };
  const gain = (id: string): Values => results[id]?.responses?.[signal]?.magnitude;
  const against = gain(PASSIVE);
  return [
    { title: "Gain", unit: "dB", figure: figure((id) => gain(id)?.map(toDecibels), LEAST_DB) },
    {
      title: "Gain against passive",
      unit: "dB",
      figure: figure(
        (id) => against && gain(id)?.map((value, index) => toDecibels(value / (against[index] ?? 1))),
        LEAST_DB,
      ),
    },
    {
      title: "Phase",
      unit: "°",
      figure: figure((id) => results[id]?.responses?.[signal]?.phase.map(toDegrees), LEAST_DEGREES),
    },
    {
      title: "Spectrum on this road",
      unit: "dB",
      figure: figure((id) => results[id]?.psd?.[spectrumOf(signal)]?.map((value) => toDecibels(value) / 2), LEAST_DB),
    },
  ];
}

/** Of body acceleration that which ISO 2631-1 weighs: what people feel. */
export const spectrumOf = (signal: string): string =>
  signal === "body_acceleration" ? "weighted_body_acceleration" : signal;
