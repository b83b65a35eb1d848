/** Every HTTP call of the page. */

import { connection } from "./connection";
import { decodeSeries } from "./decode";
import { login } from "./login";
import { ApiProblem, Unreachable, isAbort, isTransient, readProblem } from "./problem";
import { readRun } from "./roads";
import type {
  Attribution,
  Batch,
  BatchSummary,
  BatchTable,
  Catalogue,
  ControllerReport,
  EncodedSeries,
  Estimate,
  FigureTemplate,
  JsonObject,
  Link,
  LinkAnswer,
  LiveAnswer,
  NewLink,
  Paper,
  PaperFigure,
  Preset,
  RealtimeReport,
  ReadingEffects,
  RobustnessDefaults,
  RoadsAnswer,
  RunAnswer,
  Scenario,
  SeriesByStrategy,
  SharedView,
  Strategy,
  StrategyId,
  Sweep,
  Trial,
  Tuning,
  TuningEstimate,
  TuningItem,
} from "./types";

const BASE = "/api/v1";

/** Over how many roads, and which strategy the changes refer to. */
export interface RoadsWish {
  readonly roads: number;
  readonly baseline?: StrategyId;
}

/** An answer that is not a refusal. */
async function send(path: string, init: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, init);
  } catch (error) {
    if (isAbort(error)) throw error;
    connection.lost("down");
    throw new Unreachable();
  }
  if (response.ok) return response;
  const body = parse(await readText(response));
  const problem = readProblem(response.status, body, response.headers.get("retry-after"));
  if (problem.status === 502 || problem.status === 504) connection.lost("down");
  else if (isTransient(problem)) connection.lost("busy", problem.retryAfter ?? 0);
  else if (problem.kind === "token-required") login.want();
  throw problem;
}

async function request(path: string, init: RequestInit): Promise<unknown> {
  const body = parse(await readText(await send(path, init)));
  if (body === undefined) throw new ApiProblem(502, "The server's answer could not be read", []);
  connection.ok();
  return body;
}

async function readText(response: Response): Promise<string> {
  try {
    return await response.text();
  } catch (error) {
    if (isAbort(error)) throw error;
    connection.lost("down");
    throw new Unreachable();
  }
}

function parse(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

// The one place where an answer gets its type: the contract is the backend's, checked there against its OpenAPI.
async function get<T>(path: string, signal?: AbortSignal): Promise<T> {
  return (await request(BASE + path, signal ? { signal } : {})) as T;
}

interface PostOptions {
  readonly signal?: AbortSignal | undefined;
  readonly headers?: Readonly<Record<string, string>>;
}

function posting(body: unknown, { signal, headers = {} }: PostOptions = {}): RequestInit {
  return {
    method: "POST",
    headers: { "content-type": "application/json", ...headers },
    body: JSON.stringify(body),
    ...(signal ? { signal } : {}),
  };
}

async function post<T>(path: string, body: unknown, options?: PostOptions): Promise<T> {
  return (await request(BASE + path, posting(body, options))) as T;
}

function asQuery(values: Readonly<Record<string, string>>): string {
  const text = new URLSearchParams(values).toString();
  return text === "" ? "" : `?${text}`;
}

export interface SweepWish {
  readonly scenario: Scenario;
  readonly strategies: readonly StrategyId[];
  readonly sweep: Sweep;
}

/** What of a tuning is chosen beside its scenario. */
export interface TuningChoice {
  readonly strategy: StrategyId;
  readonly objectives: readonly Readonly<Record<string, unknown>>[];
  readonly limits: readonly { readonly figure: string; readonly at_most: number }[];
  readonly search: Readonly<Record<string, readonly [number, number]>>;
  readonly seeds: readonly number[];
  readonly fresh_seeds: readonly number[];
  readonly trials: number;
  readonly population: number;
  readonly seed: number;
}

export interface TuningWish extends TuningChoice {
  readonly scenario: Scenario;
}

export interface LiveWish {
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
  strategies: (signal?: AbortSignal) => get<readonly Strategy[]>("/strategies", signal),
  catalogue: (signal?: AbortSignal) => get<Catalogue>("/catalogue", signal),
  figures: async (signal?: AbortSignal) =>
    (await get<{ readonly figures: Readonly<Record<string, FigureTemplate>> }>("/figures", signal)).figures,

  createRun: async (scenario: Scenario, strategies: readonly StrategyId[], signal?: AbortSignal, over: RoadsWish | null = null) =>
    readRun(await post<RunAnswer | RoadsAnswer>("/runs", { scenario, strategies, ...over }, { signal })),
  run: async (id: string, signal?: AbortSignal) => readRun(await get<RunAnswer | RoadsAnswer>(`/runs/${encodeURIComponent(id)}`, signal)),

  estimate: (wish: SweepWish, signal?: AbortSignal) => post<Estimate>("/batches", { ...wish, dry_run: true }, { signal }),
  createBatch: (wish: SweepWish, key: string) => post<Batch>("/batches", wish, { headers: { "idempotency-key": key } }),
  batch: (id: string, signal?: AbortSignal) => get<Batch>(`/batches/${encodeURIComponent(id)}`, signal),
  cancelBatch: (id: string) => post<Batch>(`/batches/${encodeURIComponent(id)}/cancel`, {}),
  batchTable: (id: string, figures: readonly string[], signal?: AbortSignal) =>
    get<BatchTable>(`/batches/${encodeURIComponent(id)}/table?${new URLSearchParams({ figures: figures.join(",") })}`, signal),
  batchSummary: (id: string, figures: readonly string[], baseline: StrategyId | null, signal?: AbortSignal) =>
    get<BatchSummary>(`/batches/${encodeURIComponent(id)}/summary?${new URLSearchParams({ figures: figures.join(","), ...(baseline === null ? {} : { baseline }) })}`, signal),
  robustness: (signal?: AbortSignal) => get<RobustnessDefaults>("/robustness", signal),
  batchEventsAddress: (id: string, after: number) => `${BASE}/batches/${encodeURIComponent(id)}/events?after=${after}`,
  batchResultsAddress: (id: string, format: "json" | "csv" | "parquet") =>
    `${BASE}/batches/${encodeURIComponent(id)}/results?format=${format}`,

  estimateTuning: (wish: TuningWish, signal?: AbortSignal) => post<TuningEstimate>("/tunings", { ...wish, dry_run: true }, { signal }),
  createTuning: (wish: TuningWish, key: string) => post<Tuning>("/tunings", wish, { headers: { "idempotency-key": key } }),
  tunings: (signal?: AbortSignal) => get<{ readonly tunings: readonly TuningItem[] }>("/tunings?limit=50", signal),
  tuning: (id: string, signal?: AbortSignal) => get<Tuning>(`/tunings/${encodeURIComponent(id)}`, signal),
  tuningTrials: (id: string, signal?: AbortSignal) => get<{ readonly trials: readonly Trial[] }>(`/tunings/${encodeURIComponent(id)}/trials`, signal),
  cancelTuning: (id: string) => post<Tuning>(`/tunings/${encodeURIComponent(id)}/cancel`, {}),
  resumeTuning: (id: string, trials: number) => post<Tuning>(`/tunings/${encodeURIComponent(id)}/resume?${new URLSearchParams({ trials: String(trials) })}`, {}),
  tuningEventsAddress: (id: string, after: number) => `${BASE}/tunings/${encodeURIComponent(id)}/events?after=${after}`,

  /** The controller's C sources, as a zip. */
  controller: async (scenario: Scenario) => (await send(`${BASE}/controller`, posting({ scenario }))).blob(),
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

  live: (wish: LiveWish, signal?: AbortSignal) => post<LiveAnswer>("/live", wish, { signal }),

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

  seriesAddress: (id: string, strategy: StrategyId, format: "csv" | "parquet") =>
    `${BASE}/runs/${encodeURIComponent(id)}/series?${new URLSearchParams({ strategy, format })}`,

  reportAddress: (id: string, baseline: StrategyId | null, x: "position" | "time") =>
    `${BASE}/runs/${encodeURIComponent(id)}/report.html?${new URLSearchParams({ x, ...(baseline === null ? {} : { baseline }) })}`,
};

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
