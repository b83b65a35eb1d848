/** What plotly draws of a tuning: trials in the plane of two objectives, or one objective over the trials. */

import type { Generation, Trial } from "../api/types";
import type { ChartFigure } from "../plots/Chart";
import type { Palette } from "../plots/figure";
import type { LineTrace, PointTrace } from "../plots/plotly";
import { formatResult, prettyUnit, titleWithUnit } from "../units/format";
import type { Shown } from "./figures";
import { chartLayout } from "../plots/chartLayout";

export interface Look {
  readonly palette: Palette;
  /** The tuned strategy's. */
  readonly colour: string;
}

const axisTitle = ({ label, unit }: Shown) => titleWithUnit(label, unit);

const PAD = 0.12;
/** What is far worse than the paper's weights would squeeze everything else into a corner: so much of the span beyond them is shown. */
const BEYOND = 0.8;

/** An axis that shows what matters: everything in `must`, and of the rest what is not far beyond it. */
export function rangeOf(must: readonly number[], rest: readonly number[]): readonly [number, number] {
  const [low, high] = [Math.min(...must, ...rest), Math.max(...must)];
  const span = high - low || Math.abs(high) || 1;
  const top = Math.min(Math.max(high, ...rest), high + BEYOND * span);
  return [low - PAD * span, top + PAD * span];
}

const valueOf = (trial: Trial, objective: number, { scale }: Shown) => (trial.values?.[objective] ?? NaN) * scale;

interface Named {
  readonly trial: Trial;
  readonly name: string;
}

export interface FrontInput extends Look {
  readonly trials: readonly Trial[];
  readonly front: readonly Trial[];
  /** The paper's weights, the scenario's, the balanced ones. */
  readonly named: readonly Named[];
  readonly picked: number | null;
  /** Which objectives, by place. */
  readonly x: number;
  readonly y: number;
  readonly objectives: readonly Shown[];
}

function textOf(trial: Trial, objectives: readonly Shown[], name?: string): string {
  const values = objectives.map((shown, index) => `${shown.label}: ${formatResult(valueOf(trial, index, shown), 4)} ${prettyUnit(shown.unit)}`.trim());
  return [name ?? `Trial ${trial.number}`, ...values, ...(trial.feasible ? [] : ["over a limit"])].join("<br>");
}

export function frontFigure({ trials, front, named, picked, x, y, objectives, palette, colour }: FrontInput): SearchFigure {
  const [shownX, shownY] = [objectives[x], objectives[y]];
  if (!shownX || !shownY) return { data: [], layout: chartLayout(palette, { xaxis: {}, yaxis: {} }), beyond: 0 };
  const points = (name: string, some: readonly Trial[], marker: object, names: readonly string[] = []): PointTrace => ({
    type: "scatter",
    mode: "markers",
    name,
    x: some.map((trial) => valueOf(trial, x, shownX)),
    y: some.map((trial) => valueOf(trial, y, shownY)),
    customdata: some.map(({ number }) => number),
    marker: { ...marker },
    text: some.map((trial, index) => textOf(trial, objectives, names[index])),
    hovertemplate: "%{text}<extra></extra>",
  });
  const driven = trials.filter(({ values }) => values !== null);
  const sorted = [...front].sort((a, b) => valueOf(a, x, shownX) - valueOf(b, x, shownX));
  // With three objectives the front is a surface: its points in this plane are not joined.
  const line: LineTrace = {
    type: "scatter", mode: "lines", name: "Front", opacity: 0.7, hoverinfo: "skip",
    x: sorted.map((trial) => valueOf(trial, x, shownX)), y: sorted.map((trial) => valueOf(trial, y, shownY)),
    line: { color: colour, width: 1.5, shape: "hv" },
  };
  const ring = driven.filter(({ number }) => number === picked);
  const must = [...front, ...named.map(({ trial }) => trial), ...ring];
  const along = (some: readonly Trial[], objective: number, shown: Shown) => some.map((trial) => valueOf(trial, objective, shown)).filter(Number.isFinite);
  const [rangeX, rangeY] = [rangeOf(along(must, x, shownX), along(driven, x, shownX)), rangeOf(along(must, y, shownY), along(driven, y, shownY))];
  return {
    beyond: driven.filter((trial) => valueOf(trial, x, shownX) > rangeX[1] || valueOf(trial, y, shownY) > rangeY[1]).length,
    data: [
      points("Over a limit", driven.filter(({ feasible }) => !feasible), { color: palette.text, size: 6, symbol: "x-thin-open", opacity: 0.5 }),
      points("Trials", driven.filter(({ feasible }) => feasible), { color: palette.text, size: 5, opacity: 0.35 }),
      ...(objectives.length === 2 ? [line] : []),
      points("Front", sorted, { color: colour, size: 9, symbol: "circle", line: { width: 0.75, color: palette.text } }),
      points("Named", named.map(({ trial }) => trial), { color: palette.text, size: 11, symbol: named.map(({ name }) => symbolOf(name)) }, named.map(({ name }) => name)),
      ...(ring.length > 0 ? [points("Picked", ring, { color: palette.text, size: 18, symbol: "circle-open", line: { width: 2, color: palette.text } })] : []),
    ],
    layout: chartLayout(palette, {
      xaxis: { title: { text: axisTitle(shownX) }, range: rangeX },
      yaxis: { title: { text: axisTitle(shownY) }, range: rangeY },
      uirevision: `${x} ${y}`, // somebody's zoom stays while trials arrive
      annotations: named.map(({ trial, name }) => ({
        text: name, x: valueOf(trial, x, shownX), y: valueOf(trial, y, shownY), xanchor: "left", yanchor: "bottom", xshift: 6, yshift: 3,
        showarrow: false, font: { size: 11, color: palette.text },
      })),
    }),
  };
}

const symbolOf = (name: string) => (name.startsWith("The paper") ? "square" : name.startsWith("The scenario") ? "triangle-up" : "diamond");

/** A plot, and how many points lie beyond its axes as it opens. */
export interface SearchFigure extends ChartFigure {
  readonly beyond: number;
}

export interface HistoryInput extends Look {
  readonly trials: readonly Trial[];
  readonly paper: Trial | null;
  readonly picked: number | null;
  readonly shown: Shown;
}

/** Each trial that was better than all before it, and the last one. */
function bestSoFar(driven: readonly Trial[], shown: Shown): readonly { readonly number: number; readonly value: number }[] {
  let least = Infinity;
  const better = driven.flatMap((trial) => {
    const value = valueOf(trial, 0, shown);
    if (!trial.feasible || value >= least) return [];
    least = value;
    return [{ number: trial.number, value }];
  });
  const last = driven.at(-1);
  return last && better.length > 0 ? [...better, { number: last.number, value: least }] : better;
}

/** One objective: every trial, and the best so far as a line. */
export function historyFigure({ trials, paper, picked, shown, palette, colour }: HistoryInput): SearchFigure {
  const driven = trials.filter(({ values }) => values !== null);
  const points = (name: string, some: readonly Trial[], marker: object): PointTrace => ({
    type: "scatter",
    mode: "markers",
    name,
    x: some.map(({ number }) => number),
    y: some.map((trial) => valueOf(trial, 0, shown)),
    customdata: some.map(({ number }) => number),
    marker: { ...marker },
    text: some.map((trial) => textOf(trial, [shown])),
    hovertemplate: "%{text}<extra></extra>",
  });
  const best = bestSoFar(driven, shown);
  const reference = paper ? valueOf(paper, 0, shown) : NaN;
  const values = driven.map((trial) => valueOf(trial, 0, shown));
  const must = [...best.map(({ value }) => value), reference].filter(Number.isFinite);
  const line: LineTrace = {
    type: "scatter", mode: "lines", name: "Best so far", opacity: 1, hoverinfo: "skip",
    x: best.map(({ number }) => number), y: best.map(({ value }) => value), line: { color: colour, width: 2.5, shape: "hv" },
  };
  const ring = driven.filter(({ number }) => number === picked);
  const range = must.length > 0 ? rangeOf(must, values) : null;
  return {
    beyond: range ? values.filter((value) => value > range[1]).length : 0,
    data: [
      points("Over a limit", driven.filter(({ feasible }) => !feasible), { color: palette.text, size: 6, symbol: "x-thin-open", opacity: 0.5 }),
      points("Trials", driven.filter(({ feasible }) => feasible), { color: palette.text, size: 6, opacity: 0.4 }),
      line,
      ...(ring.length > 0 ? [points("Picked", ring, { color: palette.text, size: 18, symbol: "circle-open", line: { width: 2, color: palette.text } })] : []),
    ],
    layout: chartLayout(palette, {
      xaxis: { title: { text: "Trial" }, rangemode: "tozero" },
      yaxis: { title: { text: axisTitle(shown) }, ...(range ? { range } : {}) },
      uirevision: "history",
      shapes: Number.isFinite(reference)
        ? [{ type: "line", xref: "paper", x0: 0, x1: 1, y0: reference, y1: reference, line: { color: palette.text, width: 1, dash: "dash" } }]
        : [],
      annotations: Number.isFinite(reference)
        ? [{ text: "The paper’s weights", xref: "paper", x: 1, y: reference, xanchor: "right", yanchor: "bottom", showarrow: false, font: { size: 11, color: palette.text } }]
        : [],
    }),
  };
}

/** Several objectives: how much of the box under the paper's weights the front has taken. */
export function volumeFigure(history: readonly Generation[], { palette, colour }: Look): ChartFigure {
  const driven = history.flatMap(({ trials, hypervolume }) => (hypervolume === null ? [] : [{ trials, hypervolume: 100 * hypervolume }]));
  const line: LineTrace = {
    type: "scatter", mode: "lines", name: "Front", opacity: 1, hoverinfo: "skip",
    x: driven.map(({ trials }) => trials), y: driven.map(({ hypervolume }) => hypervolume), line: { color: colour, width: 2, shape: "hv" },
  };
  return {
    data: [line],
    layout: chartLayout(palette, { xaxis: { title: { text: "Trial" }, rangemode: "tozero" }, yaxis: { title: { text: "Dominated [%]" }, rangemode: "tozero" } }),
  };
}
