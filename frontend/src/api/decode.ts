/** Reads plotly's typed-array form `{dtype, bdata}` (base64, little-endian, as browsers compute) into numbers. */

import type { Band, TypedArray } from "./schema.gen";

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

/** The same entries with other values. */
export function mapped<Value, Result>(
  entries: Readonly<Record<string, Value>>,
  change: (value: Value) => Result,
): Record<string, Result> {
  return Object.fromEntries(Object.entries(entries).map(([key, value]) => [key, change(value)]));
}

export const decodeSeries = (encoded: Encoded): Series => mapped(encoded, decodeArray);

/** Series over several roads: the means by signal, beside them the extremes. */
export function decodeBand({ mean, minimum, maximum }: Band): Series {
  const named = (name: (signal: string) => string, encoded: Encoded) =>
    Object.fromEntries(Object.entries(decodeSeries(encoded)).map(([signal, values]) => [name(signal), values]));
  return { ...decodeSeries(mean), ...named(minimumOf, minimum), ...named(maximumOf, maximum) };
}
