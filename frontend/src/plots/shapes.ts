/** What stands behind the curves: driving stages, airborne stretches, reference lines. */

import type { FigureMeta, StrategyId, Summary } from "../api/types";
import { minimumOf, type Series } from "../api/decode";
import type { Axis } from "../lab/address";
import type { FigureInput } from "./curves";
import { axisKey } from "../lab/resultView";
import { stretchesBelow } from "../lib/samples";

export type Shape = Readonly<Record<string, unknown>>;

const AIRBORNE_OPACITY = 0.28;
/** Height of the marks that tell when each strategy is on the bump, as a part of the panel. */
const MARK = 0.022;

function upright(x0: number, x1: number, fillcolor: string, rest: Shape = {}): Shape {
  return {
    type: "rect",
    xref: "x",
    yref: "paper",
    x0,
    x1,
    y0: 0,
    y1: 1,
    layer: "below",
    line: { width: 0 },
    fillcolor,
    ...rest,
  };
}

const spanEnds = (axis: Axis, span: Summary["stages"][number]): readonly [number, number] =>
  axis === "distance" ? [span.start_position, span.end_position] : [span.start_time, span.end_time];

/** The strategy whose stages are shaded: the first shown that brakes, else the first shown. */
export function stagedStrategy(
  summaries: Readonly<Record<StrategyId, Summary>>,
  strategies: readonly StrategyId[],
): StrategyId | undefined {
  const shown = strategies.filter((strategy) => strategy in summaries);
  return shown.find((strategy) => summaries[strategy]?.stages.some(({ stage }) => stage === "brake")) ?? shown[0];
}

/** From the first to the last sample between the ends at which the brakes are on; `null` where there is none. */
function pressed(
  series: Series | undefined,
  axis: Axis,
  [from, to]: readonly [number, number],
  braking: number,
): readonly [number, number] | null {
  const samples = series?.[axisKey(axis)];
  const on = samples?.filter((x, index) => x >= from && x <= to && (series?.brake_pressure?.[index] ?? 0) >= braking);
  const [first, last] = [on?.[0], on?.at(-1)];
  return first === undefined || last === undefined ? null : [first, last];
}

/** As backend/runs/figures.py shades them. Stages agree by distance; over time they are one strategy's, and small marks tell the others' bumps. */
export function stageShapes({
  template,
  sourceSeries,
  summaries,
  strategies: shown,
  axis,
}: Omit<FigureInput, "series" | "range" | "palette">): readonly Shape[] {
  const strategies = shown.map(({ id }) => id);
  const staged = stagedStrategy(summaries, strategies);
  const { stage_fills: fills, braking } = template.layout.meta;
  const shading = (staged === undefined ? [] : (summaries[staged]?.stages ?? [])).flatMap((span): Shape[] => {
    const fill = fills[span.stage];
    const ends = spanEnds(axis, span);
    const bounds = span.stage === "brake" ? pressed(sourceSeries[staged ?? ""], axis, ends, braking) : ends;
    return fill === undefined || bounds === null ? [] : [upright(...bounds, fill)];
  });
  if (axis === "distance") return shading;
  const marks = shown.flatMap(({ id: strategy, colour }, index) => {
    const bump = summaries[strategy]?.stages.find(({ stage }) => stage === "bump");
    const top = 1 - index * MARK * 1.4;
    return bump ? [upright(...spanEnds(axis, bump), colour, { y0: top - MARK, y1: top })] : [];
  });
  return [...shading, ...marks];
}

/** Where a tyre's dynamic load falls below minus its static load, on one road at least: there the wheel would leave it. */
export function airborneShapes({ template, series, summaries, strategies, axis }: FigureInput): readonly Shape[] {
  const lift = Object.entries(template.layout.meta.reference_factors).find(
    ([key, factors]) => key.endsWith("static_load") && factors.includes(-1),
  )?.[0];
  if (lift === undefined) return [];
  const sample = axis === "distance" ? "position" : "time";
  return strategies.flatMap(({ id: strategy, colour }) => {
    const limit = summaries[strategy]?.reference[lift];
    const x = series[strategy]?.[sample];
    const { signal } = template.layout.meta;
    const load = series[strategy]?.[minimumOf(signal)] ?? series[strategy]?.[signal];
    if (typeof limit !== "number" || !x || !load) return [];
    return stretchesBelow(x, load, -limit).map(([from, to]) =>
      upright(from, to, colour, { opacity: AIRBORNE_OPACITY }),
    );
  });
}

/** Each reference's value in the shown unit, once, whichever strategies have it. */
export function referenceValues(meta: FigureMeta, used: readonly Summary[]): readonly number[] {
  const values = Object.entries(meta.reference_factors).flatMap(([key, factors]) =>
    used.flatMap((summary) => {
      const value = summary.reference[key];
      return typeof value === "number" ? factors.map((factor) => factor * value * meta.scale) : [];
    }),
  );
  return [...new Set(values)];
}

function band(meta: FigureMeta, used: readonly Summary[]): readonly [number, number] | null {
  const [centreKey, halfKey] = meta.band ?? [];
  if (centreKey === undefined || halfKey === undefined) return null;
  for (const { reference } of used) {
    const [centre, half] = [reference[centreKey], reference[halfKey]];
    if (typeof centre === "number" && typeof half === "number")
      return [(centre - half) * meta.scale, (centre + half) * meta.scale];
  }
  return null;
}

export function referenceShapes(meta: FigureMeta, used: readonly Summary[]): readonly Shape[] {
  const across = { xref: "paper", yref: "y", x0: 0, x1: 1, layer: "below" };
  const lines = referenceValues(meta, used).map((y) => ({
    ...across,
    type: "line",
    y0: y,
    y1: y,
    line: { color: meta.neutral, dash: "dash", width: 1 },
  }));
  const target = band(meta, used);
  return target
    ? [
        ...lines,
        { ...across, type: "rect", y0: target[0], y1: target[1], line: { width: 0 }, fillcolor: meta.band_fill },
      ]
    : lines;
}
