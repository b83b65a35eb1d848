/** How often a control step took how long, over bins that grow in ratio. */

import type { Times } from "../../api/types";
import type { ChartFigure } from "../../plots/Chart";
import { type Palette, chartLayout, referenceLine } from "../../plots/palettes";
import { formatWhole } from "../../units/format";
import { formatTime } from "./effort";

interface Look {
  readonly palette: Palette;
  readonly colour: string;
  /** Of its axis, where nothing beside it says what it counts. */
  readonly title?: string;
}

const TICKS = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];

export function histogramFigure(
  { edges, counts }: Times,
  deadline: number,
  { palette, colour, title }: Look,
): ChartFigure {
  const logs = edges.map(Math.log10);
  const bin = (index: number) => [logs[index] ?? 0, logs[index + 1] ?? 0] as const;
  const [low, high] = [logs[0] ?? -6, logs.at(-1) ?? -1];
  const at = Math.log10(deadline);
  return {
    data: [
      {
        type: "bar",
        name: "Steps",
        // Drawn over the logarithm, as plotly's bars have no width of their own on a logarithmic axis.
        x: counts.map((_, index) => (bin(index)[0] + bin(index)[1]) / 2),
        y: counts,
        width: counts.map((_, index) => 0.94 * (bin(index)[1] - bin(index)[0])),
        marker: { color: colour },
        text: counts.map(
          (number, index) =>
            `${formatTime(edges[index] ?? 0)} to ${formatTime(edges[index + 1] ?? 0)}: ${formatWhole(number)}`,
        ),
        textposition: "none",
        hovertemplate: "%{text}<extra></extra>",
      },
    ],
    layout: chartLayout(palette, {
      margin: { l: 52, r: 12, t: 18, b: 36 },
      dragmode: false,
      xaxis: {
        ...(title !== undefined && { title: { text: title } }),
        range: [low, high],
        tickvals: TICKS.map(Math.log10),
        ticktext: TICKS.map(formatTime),
        fixedrange: true,
      },
      yaxis: { title: { text: "Steps" }, rangemode: "tozero", fixedrange: true },
      ...referenceLine(palette, "x", at, "deadline", "center"),
    }),
  };
}

export const histogramTable = ({ edges, counts }: Times) => [
  ["from [s]", "to [s]", "steps"],
  ...counts.map((number, index) => [edges[index], edges[index + 1], number]),
];
