/** Reads plotly's typed-array form `{dtype, bdata}` (base64, little-endian, as browsers compute) into numbers. */

import type { Band, TypedArray } from "./schema.gen";
import type { Failure, LiveAnswer, SeriesByStrategy, Summary } from "./types";

type Encoded = Band["mean"];

export function decodeArray(samples: TypedArray | readonly (number | null)[]): Float32Array {
  if (!("bdata" in samples)) return Float32Array.from(samples, (value) => value ?? NaN);
  const text = atob(samples.bdata);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return new Float32Array(bytes.buffer);
}

/** Series as the server sends them, by signal, decoded. */
export type Series = Readonly<Record<string, Float32Array>>;

export const minimumOf = (signal: string) => `${signal}.minimum`;
export const maximumOf = (signal: string) => `${signal}.maximum`;
export const isExtreme = (key: string) => key.includes(".");

export function decodeSeries(encoded: Encoded): Series {
  return Object.fromEntries(Object.entries(encoded).map(([signal, array]) => [signal, decodeArray(array)]));
}

/** Series over several roads: the means by signal, beside them the extremes. */
export function decodeBand({ mean, minimum, maximum }: Band): Series {
  const named = (name: (signal: string) => string, encoded: Encoded) =>
    Object.fromEntries(Object.entries(decodeSeries(encoded)).map(([signal, values]) => [name(signal), values]));
  return { ...decodeSeries(mean), ...named(minimumOf, minimum), ...named(maximumOf, maximum) };
}

interface LiveHead extends Omit<LiveAnswer, "series" | "strategies"> {
  readonly strategies: Readonly<
    Record<
      string,
      Failure | (Summary & { readonly series: { readonly signals: readonly string[]; readonly samples: number } })
    >
  >;
}

/** What `POST /live` answers in binary: the length of its JSON, the JSON, and all numbers in its order. */
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
