/** The series to draw: means over a run's roads, finer samples once somebody looks closely, all of them for differences, else those there are. */

import { useQueries, useQuery } from "@tanstack/react-query";
import { useCallback, useMemo } from "react";
import type { FigureTemplate, SeriesByStrategy } from "../api/types";
import { allSamplesQuery, DETAIL_POINTS, OVERVIEW_POINTS, seriesQuery } from "../server/queries";
import { useFigures } from "../server/useCatalogues";
import { axisKey, type ResultView } from "../lab/resultView";
import type { Variant } from "../lab/compare";
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
const signalsOf = (figures: Figures) =>
  Object.entries(figures).flatMap(([name, { layout }]) => (name === "road" ? [] : [layout.meta.signal]));

const computedIn = ({ summaries }: Result) => Object.keys(summaries);
const hasMeans = ({ over, runId, missing }: Result) => over !== null && runId !== null && missing === null;

const meansQuery = (shown: Result, figures: Figures) => ({
  ...seriesQuery(shown.runId ?? "", computedIn(shown), OVERVIEW_POINTS, signalsOf(figures)),
  enabled: hasMeans(shown),
});

/** A band has three curves: half as many samples of each. */
const detailQuery = (shown: Result, signals: readonly string[] | null) =>
  seriesQuery(shown.runId ?? "", computedIn(shown), signals ? DETAIL_POINTS / 2 : DETAIL_POINTS, signals);

/** Differences are taken of all samples: two curves that were thinned at different places differ where the runs do not. */
const allQuery = (shown: Result, figures: Figures) =>
  allSamplesQuery(shown.runId ?? "", computedIn(shown), signalsOf(figures), hasMeans(shown));

/** Means and extremes over the roads of a result; `undefined` of one road, or until they are there. */
function useMeans(shown: Result, figures: Figures): SeriesByStrategy | undefined {
  const means = useQuery(meansQuery(shown, figures)).data;
  return hasMeans(shown) ? means : undefined;
}

const NOTHING: SeriesByStrategy = {};

interface Detail {
  readonly series: SeriesByStrategy;
  /** Finer samples are on their way. */
  readonly waiting: boolean;
  /** Why there are none, where no others can be shown. */
  readonly failure: Error | null;
}

export function useDetail(drawn: Drawn): Detail {
  const figures = useFigures();
  const { shown, differences } = drawn;
  const means = useMeans(shown, figures);
  const isStored = shown.runId !== null;
  const all = useQuery({ ...allQuery(shown, figures), enabled: differences && isStored });
  const series = means ?? drawn.series;
  const needed = !differences && needsDetail({ ...drawn, series });
  const detail = useQuery({ ...detailQuery(shown, means ? signalsOf(figures) : null), enabled: needed });
  if (differences && isStored) {
    const waiting = all.isFetching && all.data === undefined;
    return { series: all.data ?? NOTHING, waiting, failure: all.error };
  }
  return { series: needed && detail.data ? detail.data : series, waiting: detail.isLoading, failure: null };
}

/** What else is drawn beside means is means too; beside one road's curves it is one road's. */
export function useLayered({ shown: { over }, before, pins }: Pick<ResultView, "shown" | "before" | "pins">) {
  const figures = useFigures();
  const others = useMemo(
    () => (over ? [...(before ? [before] : []), ...pins].map(({ shown }) => shown).filter(hasMeans) : []),
    [over, before, pins],
  );
  const means = useQueries({
    queries: others.map((other) => meansQuery(other, figures)),
    combine: useCallback(
      (results: readonly { readonly data: SeriesByStrategy | undefined }[]) => results.map(({ data }) => data),
      [],
    ),
  });
  return useMemo(() => {
    const averaged = <Of extends Variant>(variant: Of): Of => ({
      ...variant,
      shown: { ...variant.shown, series: means[others.indexOf(variant.shown)] ?? variant.shown.series },
    });
    return { before: before && averaged(before), pins: pins.map(averaged) };
  }, [before, pins, means, others]);
}

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
export function useCurves(resultView: ResultView): Curves {
  const { shown } = resultView;
  const figures = useFigures();
  const subtracted = resultView.differences ? resultView.reference?.shown : undefined;
  const [means, others] = [useMeans(shown, figures), useMeans(subtracted ?? shown, figures)];
  const other = subtracted ? { ...resultView, shown: subtracted, series: subtracted.series } : resultView;
  const hasBoth = means !== undefined && others !== undefined && roadsOf(shown) === roadsOf(other.shown);
  if (subtracted && !hasBoth) return { own: onOneRoad(resultView), other: onOneRoad(other), roads: undefined };
  return { own: resultView, other, roads: hasBoth ? roadsOf(shown) : undefined };
}
