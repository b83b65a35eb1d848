/** Every HTTP call of the page that no job has. */

import { decodeBand, decodeSeries } from "./decode";
import { asQuery, BASE, get, post, postFile, send, sending } from "./http";
import { readRun } from "./roads";
import type {
  Attribution,
  Catalogue,
  ControllerReport,
  CreatedRoad,
  EncodedBand,
  EncodedSeries,
  FigureTemplate,
  JsonObject,
  Link,
  LinkAnswer,
  LiveAnswer,
  MeasuredRoad,
  NewLink,
  Paper,
  PaperFigure,
  Preset,
  Question,
  RealtimeReport,
  ReadingEffects,
  RoadsAnswer,
  RunAnswer,
  Scenario,
  SeriesByStrategy,
  SharedView,
  Solution,
  Strategy,
  StrategyId,
  VehiclePreset,
} from "./types";

/** Over how many roads, and which strategy the changes refer to. */
export interface RoadsOptions {
  readonly roads: number;
  readonly baseline?: StrategyId;
}

export interface LiveRequest {
  readonly scenario: Scenario;
  readonly strategies: readonly StrategyId[];
  readonly signals: readonly string[];
  readonly points: number;
}

interface SeriesAnswer {
  readonly strategy?: StrategyId;
  readonly series?: EncodedSeries;
  readonly strategies?: Readonly<Record<StrategyId, EncodedSeries>>;
}

export const api = {
  schema: (signal?: AbortSignal) => get<JsonObject>("/schema", signal),
  presets: (signal?: AbortSignal) => get<readonly Preset[]>("/presets", signal),
  sendRoad: (csv: string) => postFile<CreatedRoad>("/roads", csv, "text/csv"),
  road: (id: string, signal?: AbortSignal) => get<MeasuredRoad>(`/roads/${encodeURIComponent(id)}?points=2`, signal),
  vehicles: (signal?: AbortSignal) => get<readonly VehiclePreset[]>("/vehicles", signal),
  strategies: (signal?: AbortSignal) => get<readonly Strategy[]>("/strategies", signal),
  catalogue: (signal?: AbortSignal) => get<Catalogue>("/catalogue", signal),
  figures: async (signal?: AbortSignal) =>
    (await get<{ readonly figures: Readonly<Record<string, FigureTemplate>> }>("/figures", signal)).figures,

  createRun: async (scenario: Scenario, strategies: readonly StrategyId[], signal?: AbortSignal, over: RoadsOptions | null = null) =>
    readRun(await post<RunAnswer | RoadsAnswer>("/runs", { scenario, strategies, ...over }, { signal })),
  run: async (id: string, signal?: AbortSignal) => readRun(await get<RunAnswer | RoadsAnswer>(`/runs/${encodeURIComponent(id)}`, signal)),

  solve: (scenario: Scenario, question: Question, roads: number, signal?: AbortSignal) =>
    post<Solution>("/solve", { scenario, ...question, roads }, { signal }),

  /** The controller's C sources, as a zip. */
  controller: async (scenario: Scenario) => (await send(`${BASE}/controller`, sending("POST", { scenario }))).blob(),
  controllerReport: (scenario: Scenario, signal?: AbortSignal) => post<ControllerReport>("/controller/report", { scenario }, { signal }),
  driveByClock: (scenario: Scenario, signal?: AbortSignal) => post<RealtimeReport>("/controller/realtime", { scenario }, { signal }),

  shareBatch: (batchId: string, view: SharedView) => post<NewLink>("/links", { batch_id: batchId, view }),
  share: (runId: string, view: SharedView) => post<NewLink>("/links", { run_id: runId, view }),
  link: async (slug: string, signal?: AbortSignal): Promise<Link> => {
    const link = await get<LinkAnswer>(`/links/${encodeURIComponent(slug)}`, signal);
    return { ...link, run: link.run && readRun(link.run) };
  },

  /** What is there of it; it is complete when asked often enough. */
  paper: (choices: Readonly<Record<string, string>>, signal?: AbortSignal) => get<Paper>(`/paper${asQuery({ ...choices, partial: "true" })}`, signal),
  paperReadings: (roads: Readonly<Record<string, string>>, signal?: AbortSignal) => get<ReadingEffects>(`/paper/readings${asQuery(roads)}`, signal),
  paperAttribution: (roads: Readonly<Record<string, string>>, signal?: AbortSignal) => get<Attribution>(`/paper/attribution${asQuery(roads)}`, signal),
  paperFigures: async (roads: Readonly<Record<string, string>>, signal?: AbortSignal) =>
    (await get<{ readonly figures: readonly PaperFigure[] }>(`/paper/figures${asQuery(roads)}`, signal)).figures,
  paperReportAddress: (choices: Readonly<Record<string, string>>) => `${BASE}/paper/report.html${asQuery(choices)}`,

  live: (body: LiveRequest, signal?: AbortSignal) => post<LiveAnswer>("/live", body, { signal }),

  series: async (
    id: string,
    strategies: readonly StrategyId[],
    points: number,
    signal?: AbortSignal,
  ): Promise<SeriesByStrategy> => {
    const query = new URLSearchParams({ strategy: strategies.join(","), points: String(points), encoding: "base64" });
    const answer = await get<SeriesAnswer>(`/runs/${encodeURIComponent(id)}/series?${query}`, signal);
    const encoded = answer.strategies ?? (answer.strategy && answer.series ? { [answer.strategy]: answer.series } : {});
    return Object.fromEntries(Object.entries(encoded).map(([name, series]) => [name, decodeSeries(series)]));
  },

  /** Of a run over several roads: means and extremes. */
  bands: async (id: string, strategies: readonly StrategyId[], signals: readonly string[], points: number, signal?: AbortSignal): Promise<SeriesByStrategy> => {
    const query = new URLSearchParams({ strategy: strategies.join(","), signals: signals.join(","), points: String(points), encoding: "base64" });
    const answer = await get<{ readonly strategies: Readonly<Record<StrategyId, EncodedBand>> }>(`/runs/${encodeURIComponent(id)}/bands?${query}`, signal);
    return Object.fromEntries(Object.entries(answer.strategies).map(([name, band]) => [name, decodeBand(band)]));
  },

  seriesAddress: (id: string, strategy: StrategyId, format: "csv" | "parquet") =>
    `${BASE}/runs/${encodeURIComponent(id)}/series?${new URLSearchParams({ strategy, format })}`,

  reportAddress: (id: string, baseline: StrategyId | null, x: "position" | "time") =>
    `${BASE}/runs/${encodeURIComponent(id)}/report.html?${new URLSearchParams({ x, ...(baseline === null ? {} : { baseline }) })}`,
};

export type Api = typeof api;

export type Readiness = "ready" | "starting" | "down";

/** Asks whether the server can work; never throws. */
export async function probe(signal: AbortSignal): Promise<Readiness> {
  try {
    const response = await fetch("/readyz", { signal, cache: "no-store" });
    if (response.ok) return "ready";
    return response.status === 503 ? "starting" : "down";
  } catch {
    return "down";
  }
}
