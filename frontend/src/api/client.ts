/** Runs, links and curves: what the page reads in another form than the server answers. */

import { decodeBand, decodeSeries, mapped } from "./decode";
import { ask, askFile } from "./http";
import { readBatch } from "./jobs";
import type {
  Link,
  LiveRequest,
  RunRequest,
  Scenario,
  SeriesByStrategy,
  StrategyId,
  Failure,
  OverRoads,
  RoadsAnswer,
  Run,
  RunAnswer,
  Summary,
  LiveAnswer,
} from "./types";

/** Over how many roads, and which strategy the changes refer to; left out is one road, and the service's choice. */
export type RoadsOptions = Pick<RunRequest, "roads" | "baseline">;

const curves = (strategies: readonly StrategyId[], points: number, signals: readonly string[] | null) =>
  ({ strategy: strategies.join(","), points, encoding: "base64", signals: signals?.join(",") ?? null }) as const;

export const api = {
  createRun: async (
    scenario: Scenario,
    strategies: readonly StrategyId[],
    signal?: AbortSignal,
    over: RoadsOptions | null = null,
  ) => readRun(await ask("post", "/runs", { body: { scenario, strategies, ...over } }, signal)),
  run: async (id: string, signal?: AbortSignal) => readRun(await ask("get", "/runs/{id}", { path: { id } }, signal)),
  link: async (slug: string, signal?: AbortSignal): Promise<Link> => {
    const link = await ask("get", "/links/{slug}", { path: { slug } }, signal);
    return { ...link, run: link.run && readRun(link.run), batch: link.batch && (await readBatch(link.batch)) };
  },
  live: async (body: Omit<LiveRequest, "encoding">, signal?: AbortSignal) => {
    const question = { body: { ...body, encoding: "binary" } } as const;
    return decodeLive(await askFile("post", "/live", question, (response) => response.arrayBuffer(), signal));
  },

  series: async (
    id: string,
    strategies: readonly StrategyId[],
    points: number,
    signal?: AbortSignal,
    signals: readonly string[] | null = null,
  ) => {
    const question = { path: { id }, query: curves(strategies, points, signals) };
    const answer = await ask("get", "/runs/{id}/series", question, signal);
    return mapped("strategies" in answer ? answer.strategies : { [answer.strategy]: answer.series }, decodeSeries);
  },
  /** Of a run over several roads: means and extremes. */
  bands: async (
    id: string,
    strategies: readonly StrategyId[],
    signals: readonly string[],
    points: number,
    signal?: AbortSignal,
  ) => {
    const question = { path: { id }, query: curves(strategies, points, signals) };
    return mapped((await ask("get", "/runs/{id}/bands", question, signal)).strategies, decodeBand);
  },
};

export type Api = typeof api;

/** A run as the page has it. */
export function readRun(answer: RunAnswer | RoadsAnswer): Run {
  if (!("roads" in answer)) return { ...answer, over: null };
  const { roads, baseline, changes, strategies, ...run } = answer;
  const estimates: Record<StrategyId, OverRoads["estimates"][StrategyId]> = {};
  const means: Record<StrategyId, Summary | Failure> = {};
  for (const [id, entry] of Object.entries(strategies)) {
    if (entry.status === "ok") {
      const { metrics, comfort } = entry;
      estimates[id] = { metrics, comfort };
      means[id] = {
        ...entry,
        metrics: mapped(metrics, (signals) => mapped(signals, ({ rms, peak }) => ({ rms: rms.mean, peak: peak.mean }))),
        comfort: mapped(comfort, ({ mean }) => mean),
      };
    } else means[id] = entry;
  }
  return { ...run, strategies: means, over: { roads, baseline, changes, estimates } };
}

interface LiveHead extends Omit<LiveAnswer, "series" | "strategies"> {
  readonly strategies: Readonly<
    Record<
      string,
      Failure | (Summary & { readonly series: { readonly signals: readonly string[]; readonly samples: number } })
    >
  >;
}

/** The length of its JSON, the JSON, and all numbers in its order. */
export function decodeLive(content: ArrayBuffer): LiveAnswer {
  const length = new DataView(content).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(content, 4, length))) as LiveHead;
  let at = 4 + length;
  const series: Record<string, SeriesByStrategy[string]> = {};
  for (const [strategy, entry] of Object.entries(head.strategies)) {
    if (entry.status === "failed") continue;
    const { signals, samples } = entry.series;
    series[strategy] = Object.fromEntries(
      signals.map((signal, index) => [signal, new Float32Array(content, at + 4 * samples * index, samples)]),
    );
    at += 4 * samples * signals.length;
  }
  return { ...head, series };
}
