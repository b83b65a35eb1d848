/** The spread and the fields alone as charts for a file: the page draws both as plain bars. */

import type { BatchSummary, Strategy } from "../../api/types";
import { fullName, type Metric } from "../../server/metrics";
import { chartLayout, ON_PAPER } from "../../plots/palettes";
import type { ChartOnPaper } from "../../plots/paperChart";
import type { LineTrace, PointTrace } from "../../plots/plotly";
import { titleWithUnit } from "../../units/format";
import { quantile } from "./summary";
import type { Tornado } from "./tornado";

type Ends = readonly [number | null | undefined, number | null | undefined];

const bars = (
  name: string,
  names: readonly string[],
  ends: readonly Ends[],
  color: string,
  width: number,
  shift = 0,
): LineTrace => ({
  type: "scatter",
  mode: "lines",
  name,
  opacity: 1,
  hoverinfo: "skip",
  line: { color, width },
  x: ends.flatMap(([low, high]) => [low ?? null, high ?? null, null]),
  y: names.flatMap((_, index) => [index + shift, index + shift, null]),
});

function points(name: string, values: readonly (number | null | undefined)[], symbol: string): PointTrace {
  const there = values.flatMap((value, index) => (typeof value === "number" ? [{ value, index }] : []));
  return {
    type: "scatter",
    mode: "markers",
    name,
    customdata: [],
    x: there.map(({ value }) => value),
    y: there.map(({ index }) => index),
    marker: { color: ON_PAPER.text, symbol, size: 9, line: { color: ON_PAPER.text, width: 2 } },
  };
}

/** The first name stands above. */
const layoutOf = (title: string, names: readonly string[], rest: object) =>
  chartLayout(ON_PAPER, {
    margin: { r: 12 },
    xaxis: { title: { text: title.replace(", ", ",<br>") }, ...rest },
    yaxis: {
      tickvals: names.map((_, index) => index),
      ticktext: names,
      range: [names.length - 0.5, -0.5],
      showgrid: false,
    },
  });

const PERCENTS = [5, 25, 50, 75, 95];

export function spreadChart(summary: BatchSummary, strategies: readonly Strategy[], figure: Metric): ChartOnPaper {
  const rows = strategies.flatMap(({ id, label }) => {
    const results = summary.strategies[id]?.figures[figure.key];
    const scaled = (value: number | null | undefined) => (typeof value === "number" ? value * figure.scale : null);
    return results
      ? [
          {
            label,
            nominal: scaled(results.nominal),
            worst: scaled(results.highest?.value),
            quantiles: PERCENTS.map((percent) => scaled(quantile(summary, results, percent))),
          },
        ]
      : [];
  });
  const names = rows.map(({ label }) => label);
  const title = titleWithUnit(fullName(figure), figure.unit);
  const data = [
    bars(
      "5 to 95 %",
      names,
      rows.map(({ quantiles: [low, , , , high] }): Ends => [low, high]),
      "#9db8d9",
      5,
    ),
    bars(
      "25 to 75 %",
      names,
      rows.map(({ quantiles: [, low, , high] }): Ends => [low, high]),
      "#3b6fb5",
      11,
    ),
    points(
      "Median",
      rows.map(({ quantiles: [, , median] }) => median),
      "line-ns",
    ),
    points(
      "Nominal",
      rows.map(({ nominal }) => nominal),
      "diamond-open",
    ),
    points(
      "Worst case",
      rows.map(({ worst }) => worst),
      "circle-open",
    ),
  ];
  return {
    figure: { data, layout: layoutOf(title, names, { rangemode: "tozero" }) },
    legend: data.map(({ name }) => name),
    table: [
      [
        "Strategy",
        ...["Nominal", ...PERCENTS.map((percent) => `${percent} %`), "Worst case"].map((head) => `${head}: ${title}`),
      ],
      ...rows.map(({ label, nominal, quantiles, worst }) => [label, nominal, ...quantiles, worst]),
    ],
  };
}

/** `names` and `ends` are those of the bars' fields and of their ends' places, as the page writes them. */
export function tornadoChart(
  { nominal, bars: fields }: Tornado,
  figure: Metric,
  names: readonly string[],
  places: readonly (readonly [string, string])[],
): ChartOnPaper {
  const base = nominal * figure.scale;
  const title = titleWithUnit(fullName(figure), figure.unit);
  const valueOf = (side: "low" | "high") =>
    fields.map((field) => (field[side] ? field[side].value * figure.scale : null));
  const [low, high] = [valueOf("low"), valueOf("high")];
  const fromBase = (values: typeof low) => values.map((value): Ends => (value === null ? [null, null] : [base, value]));
  const data = [
    bars("Lowest value of the field", names, fromBase(low), "#9db8d9", 5, -0.2),
    bars("Highest value of the field", names, fromBase(high), "#3b6fb5", 5, 0.2),
  ];
  const layout = layoutOf(title, names, {});
  return {
    figure: {
      data,
      layout: {
        ...layout,
        shapes: [
          { type: "line", x0: base, x1: base, yref: "paper", y0: 0, y1: 1, line: { color: ON_PAPER.text, width: 1 } },
        ],
      },
    },
    legend: data.map(({ name }) => name),
    table: [
      ["Field", "Lowest", title, "Highest", title],
      ["The scenario itself", "", base, "", base],
      ...names.map((name, index) => [name, places[index]?.[0], low[index], places[index]?.[1], high[index]]),
    ],
  };
}
