import { useQuery } from "@tanstack/react-query";
import type { SeriesByStrategy } from "../api/types";
import { DETAIL_POINTS, seriesQuery } from "../state/queries";
import { axisKey, type Scene } from "../state/scene";
import { covering } from "./samples";

/** Fewer samples of a curve in the range shown are too coarse for a screen. */
const LEAST_SAMPLES = 200;

/** The series to draw: an exact run's finer samples once somebody looks closely, else those there are. */
export function useDetail({ shown, ids, series, axis, range }: Scene): SeriesByStrategy {
  const coarse = ids.some((id) => {
    const samples = series[id]?.[axisKey(axis)];
    if (!samples) return false;
    const [from, to] = covering(samples, range[0], range[1]);
    return to - from < LEAST_SAMPLES;
  });
  const detail = useQuery({
    ...seriesQuery(shown.runId ?? "", Object.keys(shown.summaries), DETAIL_POINTS),
    enabled: coarse && shown.runId !== null,
  });
  return coarse && shown.runId !== null && detail.data ? detail.data : series;
}
