/** What plotly draws of a tuning: trials in the plane of two objectives, or one objective over the trials. */

import type { Generation, StrategyId, Trial } from "../../api/types";
import type { ChartFigure } from "../../plots/Chart";
import type { Look } from "../../plots/useChart";
import { type Palette, chartLayout, lineTrace, referenceLine } from "../../plots/palettes";
import type { PointTrace } from "../../plots/plotly";
import { formatResult, prettyUnit, titleWithUnit } from "../../units/format";
import { humanise } from "../../scenario/schema";
import type { ShownNumber } from "./space";

interface Colours {
  readonly palette: Palette;
  /** The tuned strategy's. */
  readonly colour: string;
}

export const coloursOf = ({ palette, strategies }: Look, tuned: StrategyId): Colours => ({
  palette,
  colour: strategies.find(({ id }) => id === tuned)?.colour ?? "currentColor",
});

const axisTitle = ({ label, unit }: ShownNumber) => titleWithUnit(label, unit);

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

const valueOf = (trial: Trial, objective: number, { scale }: ShownNumber) => (trial.values?.[objective] ?? NaN) * scale;

interface Named {
  readonly trial: Trial;
  readonly name: string;
}

interface Input extends Colours {
  readonly trials: readonly Trial[];
  readonly picked: number | null;
}

export interface FrontInput extends Input {
  readonly front: readonly Trial[];
  /** The paper's weights, the scenario's, the balanced ones. */
  readonly named: readonly Named[];
  /** Which objectives, by place. */
  readonly x: number;
  readonly y: number;
  readonly objectives: readonly ShownNumber[];
}

function textOf(trial: Trial, objectives: readonly ShownNumber[], name?: string): string {
  const values = objectives.map((shown, index) =>
    `${shown.label}: ${formatResult(valueOf(trial, index, shown), 4)} ${prettyUnit(shown.unit)}`.trim(),
  );
  return [name ?? `Trial ${trial.number}`, ...values, ...(trial.feasible ? [] : ["over a limit"])].join("<br>");
}

/** Trials as points by two of their values: all that ran, a ring around the selected one, and what makes points of others. */
function pointsBy(
  { trials, picked, palette }: Input,
  objectives: readonly ShownNumber[],
  x: (trial: Trial) => number,
  y: (trial: Trial) => number,
) {
  const points = (name: string, some: readonly Trial[], marker: object, names: readonly string[] = []): PointTrace => ({
    type: "scatter",
    mode: "markers",
    name,
    x: some.map(x),
    y: some.map(y),
    customdata: some.map(({ number }) => number),
    marker: { color: palette.text, ...marker },
    text: some.map((trial, index) => textOf(trial, objectives, names[index])),
    hovertemplate: "%{text}<extra></extra>",
  });
  const driven = trials.filter(({ values }) => values !== null);
  const over = driven.filter(({ feasible }) => !feasible);
  const within = driven.filter(({ feasible }) => feasible);
  const ringed = driven.filter(({ number }) => number === picked);
  return {
    points,
    driven,
    ringed,
    all: [
      points("Over a limit", over, { size: 6, symbol: "x-thin-open", opacity: 0.5 }),
      points("Trials", within, { size: 5, opacity: 0.35 }),
    ],
    ring:
      ringed.length > 0
        ? [points("Picked", ringed, { size: 18, symbol: "circle-open", line: { width: 2, color: palette.text } })]
        : [],
  };
}

/** A staircase. */
const steps = (name: string, along: readonly (readonly [number, number])[], color: string, width: number) =>
  lineTrace(name, { x: along.map(([x]) => x), y: along.map(([, y]) => y), color, width, shape: "hv" });

export function frontFigure(input: FrontInput): SearchFigure {
  const { front, named, x, y, objectives, palette, colour } = input;
  const [shownX, shownY] = [objectives[x], objectives[y]];
  if (!shownX || !shownY) return { data: [], layout: chartLayout(palette, { xaxis: {}, yaxis: {} }), beyond: 0 };
  const [across, up] = [(trial: Trial) => valueOf(trial, x, shownX), (trial: Trial) => valueOf(trial, y, shownY)];
  const { points, driven, ringed, all, ring } = pointsBy(input, objectives, across, up);
  const sorted = [...front].sort((a, b) => across(a) - across(b));
  const must = [...front, ...named.map(({ trial }) => trial), ...ringed];
  const range = (along: typeof up) =>
    rangeOf(must.map(along).filter(Number.isFinite), driven.map(along).filter(Number.isFinite));
  const [rangeX, rangeY] = [range(across), range(up)];
  return {
    beyond: driven.filter((trial) => across(trial) > rangeX[1] || up(trial) > rangeY[1]).length,
    data: [
      ...all,
      // With three objectives the front is a surface: its points in this plane are not joined.
      ...(objectives.length === 2
        ? [
            steps(
              "Front",
              sorted.map((trial) => [across(trial), up(trial)]),
              colour,
              1.5,
            ),
          ]
        : []),
      points("Front", sorted, { color: colour, size: 9, symbol: "circle", line: { width: 0.75, color: palette.text } }),
      points(
        "Named",
        named.map(({ trial }) => trial),
        { size: 11, symbol: named.map(({ name }) => symbolOf(name)) },
        named.map(({ name }) => name),
      ),
      ...ring,
    ],
    layout: chartLayout(palette, {
      xaxis: { title: { text: axisTitle(shownX) }, range: rangeX },
      yaxis: { title: { text: axisTitle(shownY) }, range: rangeY },
      uirevision: `${x} ${y}`, // somebody's zoom stays while trials arrive
      annotations: named.map(({ trial, name }) => ({
        text: name,
        x: across(trial),
        y: up(trial),
        xanchor: "left",
        yanchor: "bottom",
        xshift: 6,
        yshift: 3,
        showarrow: false,
        font: { size: 11, color: palette.text },
      })),
    }),
  };
}

const symbolOf = (name: string) =>
  /^The (paper|defaults)/.test(name) ? "square" : name.startsWith("The scenario") ? "triangle-up" : "diamond";

/** A plot, and how many points lie beyond its axes as it opens. */
export interface SearchFigure extends ChartFigure {
  readonly beyond: number;
}

export interface HistoryInput extends Input {
  readonly paper: Trial | null;
  /** What that one is. */
  readonly first: string;
  readonly shown: ShownNumber;
}

/** Each trial that was better than all before it, and the last one. */
function bestSoFar(
  driven: readonly Trial[],
  shown: ShownNumber,
): readonly (readonly [number: number, value: number])[] {
  let least = Infinity;
  const better = driven.flatMap((trial) => {
    const value = valueOf(trial, 0, shown);
    if (!trial.feasible || value >= least) return [];
    least = value;
    return [[trial.number, value] as const];
  });
  const last = driven.at(-1);
  return last && better.length > 0 ? [...better, [last.number, least]] : better;
}

/** One objective: every trial, and the best so far as a line. */
export function historyFigure(input: HistoryInput): SearchFigure {
  const { paper, first, shown, palette, colour } = input;
  const up = (trial: Trial) => valueOf(trial, 0, shown);
  const { driven, all, ring } = pointsBy(input, [shown], ({ number }) => number, up);
  const best = bestSoFar(driven, shown);
  const reference = paper ? up(paper) : NaN;
  const values = driven.map(up);
  const must = [...best.map(([, value]) => value), reference].filter(Number.isFinite);
  const range = must.length > 0 ? rangeOf(must, values) : null;
  return {
    beyond: range ? values.filter((value) => value > range[1]).length : 0,
    data: [...all, steps("Best so far", best, colour, 2.5), ...ring],
    layout: chartLayout(palette, {
      xaxis: { title: { text: "Trial" }, rangemode: "tozero" },
      yaxis: { title: { text: axisTitle(shown) }, ...(range ? { range } : {}) },
      uirevision: "history",
      ...(Number.isFinite(reference) && referenceLine(palette, "y", reference, humanise(first), "right")),
    }),
  };
}

/** Several objectives: how much of the box under the paper's weights the front has taken. */
export function volumeFigure(history: readonly Generation[], { palette, colour }: Colours): ChartFigure {
  const grown = history.flatMap(({ trials, hypervolume }) =>
    hypervolume === null ? [] : [[trials, 100 * hypervolume] as const],
  );
  return {
    data: [steps("Front", grown, colour, 2)],
    layout: chartLayout(palette, {
      xaxis: { title: { text: "Trial" }, rangemode: "tozero" },
      yaxis: { title: { text: "Dominated [%]" }, rangemode: "tozero" },
    }),
  };
}
