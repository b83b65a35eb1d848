/** The series to draw: means over a run's roads, finer samples once somebody looks closely, all of them for differences, else those there are. */

import { useQueries, useQuery, type QueryClient } from "@tanstack/react-query";
import { useCallback, useMemo } from "react";
import type { FigureTemplate, SeriesByStrategy } from "../api/types";
import { allSamplesQuery, DETAIL_POINTS, figuresQuery, OVERVIEW_POINTS, seriesQuery } from "../server/queries";
import { useFigures } from "../server/useCatalogues";
import { axisKey, type ResultView } from "../lab/resultView";
import { roadsOf, type Result } from "../lab/result";
import { covering } from "../lib/samples";

/** Fewer samples of a curve in the range shown are too coarse for a screen. */
const LEAST_SAMPLES = 200;

type Drawn = Pick<ResultView, "shown" | "ids" | "series" | "axis" | "range" | "differences">;

function needsDetail({ shown, ids, series, axis, range }: Drawn): boolean {
  const coarse = ids.some((id) => {
    const samples = series[id]?.[axisKey(axis)];
    if (!samples) return false;
    const [from, to] = covering(samples, range[0], range[1]);
    return to - from < LEAST_SAMPLES;
  });
  return coarse && shown.runId !== null;
}

type Figures = Readonly<Record<string, FigureTemplate>>;

/** Of the plots over all roads: the road itself and the car stay those of the first. */
const signalsOf = (figures: Figures = {}) =>
  Object.entries(figures).flatMap(([name, { layout }]) => (name === "road" ? [] : [layout.meta.signal]));

const computedIn = ({ summaries }: Result) => Object.keys(summaries);
const hasMeans = ({ over, runId, missing }: Result) => over !== null && runId !== null && missing === null;

function meansQuery(shown: Result, figures: Figures | undefined) {
  const query = seriesQuery(shown.runId ?? "", computedIn(shown), OVERVIEW_POINTS, signalsOf(figures));
  return { ...query, enabled: figures !== undefined && hasMeans(shown) };
}

/** A band has three curves: half as many samples of each. */
const detailQuery = (shown: Result, signals: readonly string[] | null) =>
  seriesQuery(shown.runId ?? "", computedIn(shown), signals ? DETAIL_POINTS / 2 : DETAIL_POINTS, signals);

/** Differences are taken of all samples: two curves that were thinned at different places differ where the runs do not. */
const allQuery = (shown: Result, figures: Figures | undefined) =>
  allSamplesQuery(shown.runId ?? "", computedIn(shown), signalsOf(figures), hasMeans(shown));

/** Means and extremes over the roads of a result; `undefined` of one road, or until they are there. */
function useMeans(shown: Result, figures: Figures): SeriesByStrategy | undefined {
  const means = useQuery(meansQuery(shown, figures)).data;
  return hasMeans(shown) ? means : undefined;
}

const NOTHING: SeriesByStrategy = {};

export function useDetail(drawn: Drawn): SeriesByStrategy {
  const figures = useFigures();
  const { shown, differences } = drawn;
  const means = useMeans(shown, figures);
  const isStored = shown.runId !== null;
  const all = useQuery({ ...allQuery(shown, figures), enabled: differences && isStored });
  const series = means ?? drawn.series;
  const needed = !differences && needsDetail({ ...drawn, series });
  const detail = useQuery({ ...detailQuery(shown, means ? signalsOf(figures) : null), enabled: needed });
  if (differences && isStored) return all.data ?? NOTHING;
  return needed && detail.data ? detail.data : series;
}

/** The same for a file: waits for the finer samples of what is on the screen. */
export async function loadDetail(client: QueryClient, drawn: Drawn): Promise<SeriesByStrategy> {
  const { shown, differences } = drawn;
  const figures = client.getQueryData(figuresQuery.queryKey);
  if (differences && shown.runId !== null) return client.query({ ...allQuery(shown, figures), staleTime: "static" });
  const means = cachedMeans(client, shown);
  const series = means ?? drawn.series;
  if (!needsDetail({ ...drawn, series })) return series;
  const signals = means ? signalsOf(figures) : null;
  return client.query({ ...detailQuery(shown, signals), staleTime: "static" });
}

function cachedMeans(client: QueryClient, shown: Result): SeriesByStrategy | undefined {
  if (!hasMeans(shown)) return undefined;
  return client.getQueryData(meansQuery(shown, client.getQueryData(figuresQuery.queryKey)).queryKey);
}

type OtherCurves = Pick<ResultView, "before" | "pins">;
type BesideShown = Pick<ResultView, "shown" | "before" | "pins">;

/** What else is drawn beside means is means too; beside one road's curves it is one road's. */
function withMeans(
  over: Result["over"],
  { before, pins }: OtherCurves,
  meansOf: (shown: Result) => SeriesByStrategy | undefined,
): OtherCurves {
  const averaged = (result: Result): Result => ({
    ...result,
    series: (over && meansOf(result)) ?? result.series,
  });
  return {
    before: before && { ...before, shown: averaged(before.shown) },
    pins: pins.map((pin) => ({ ...pin, shown: averaged(pin.shown) })),
  };
}

export function useLayered({ shown, before, pins }: BesideShown): OtherCurves {
  const figures = useFigures();
  const { over } = shown;
  const others = useMemo(
    () => (over ? [...(before ? [before] : []), ...pins].map((variant) => variant.shown).filter(hasMeans) : []),
    [over, before, pins],
  );
  const means = useQueries({
    queries: others.map((other) => meansQuery(other, figures)),
    combine: useCallback(
      (results: readonly { readonly data: SeriesByStrategy | undefined }[]) => results.map(({ data }) => data),
      [],
    ),
  });
  return useMemo(
    () => withMeans(over, { before, pins }, (result) => means[others.indexOf(result)]),
    [over, before, pins, means, others],
  );
}

/** The same for a file: what is on the screen. */
export const layeredFrom = (client: QueryClient, resultView: BesideShown): OtherCurves =>
  withMeans(resultView.shown.over, resultView, (result) => cachedMeans(client, result));

interface Curves {
  /** What the curves are of. */
  readonly own: Drawn;
  /** What they are differences to; `own` where that is one of its strategies, or none. */
  readonly other: Drawn;
  /** Over how many roads they are means; `undefined` where they are the first road's. */
  readonly roads: number | undefined;
}

const onOneRoad = (drawn: Drawn): Drawn => ({ ...drawn, shown: { ...drawn.shown, over: null } });

/** Means are subtracted from means over as many roads; where one of them is missing, the first road's curves from each other. */
function curvesOf(resultView: ResultView, meansOf: (shown: Result) => SeriesByStrategy | undefined): Curves {
  const { shown } = resultView;
  const subtracted = resultView.differences ? resultView.reference?.shown : undefined;
  const other = subtracted ? { ...resultView, shown: subtracted, series: subtracted.series } : resultView;
  const hasBoth =
    meansOf(shown) !== undefined && meansOf(other.shown) !== undefined && roadsOf(shown) === roadsOf(other.shown);
  if (subtracted && !hasBoth) return { own: onOneRoad(resultView), other: onOneRoad(other), roads: undefined };
  return { own: resultView, other, roads: hasBoth ? roadsOf(shown) : undefined };
}

export function useCurves(resultView: ResultView): Curves {
  const { shown } = resultView;
  const figures = useFigures();
  const means = useMeans(shown, figures);
  const others = useMeans(resultView.reference?.shown ?? shown, figures);
  return curvesOf(resultView, (result) => (result === shown ? means : others));
}

/** The same for a file: what is on the screen. */
export const curvesFrom = (client: QueryClient, resultView: ResultView): Curves =>
  curvesOf(resultView, (result) => cachedMeans(client, result));
