/** The series to draw: an exact run's finer samples once somebody looks closely, else those there are. */

import { useQuery, type QueryClient } from "@tanstack/react-query";
import type { SeriesByStrategy } from "../api/types";
import { DETAIL_POINTS, seriesQuery } from "../state/queries";
import { axisKey, type Scene } from "../state/scene";
import { covering } from "./samples";

/** Fewer samples of a curve in the range shown are too coarse for a screen. */
const LEAST_SAMPLES = 200;

type Drawn = Pick<Scene, "shown" | "ids" | "series" | "axis" | "range">;

function needsDetail({ shown, ids, series, axis, range }: Drawn): boolean {
  const coarse = ids.some((id) => {
    const samples = series[id]?.[axisKey(axis)];
    if (!samples) return false;
    const [from, to] = covering(samples, range[0], range[1]);
    return to - from < LEAST_SAMPLES;
  });
  return coarse && shown.runId !== null;
}

const detailQuery = ({ shown }: Drawn) => seriesQuery(shown.runId ?? "", Object.keys(shown.summaries), DETAIL_POINTS);

export function useDetail(drawn: Drawn): SeriesByStrategy {
  const needed = needsDetail(drawn);
  const detail = useQuery({ ...detailQuery(drawn), enabled: needed });
  return needed && detail.data ? detail.data : drawn.series;
}

/** The same for a file: waits for the finer samples. */
export async function loadDetail(client: QueryClient, drawn: Drawn): Promise<SeriesByStrategy> {
  return needsDetail(drawn) ? client.query({ ...detailQuery(drawn), staleTime: "static" }) : drawn.series;
}

/** What the scene's curves are differences to; the scene itself where that is one of its strategies, or none. */
export const referenceScene = (scene: Scene): Drawn =>
  scene.residual && scene.reference ? { ...scene, shown: scene.reference.shown, series: scene.reference.shown.series } : scene;
