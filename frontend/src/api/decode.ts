/** Reads plotly's typed-array form `{dtype, bdata}` (base64, little-endian) into numbers. */

export interface EncodedArray {
  readonly dtype: string;
  readonly bdata: string;
}

const LITTLE_ENDIAN = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

/** Decodes a base64 little-endian float32 or float64 array; always returns float32, which is what screens need. */
export function decodeArray({ dtype, bdata }: EncodedArray): Float32Array {
  const size = dtype === "f4" ? 4 : dtype === "f8" ? 8 : 0;
  if (size === 0) throw new Error(`Unknown array type ${dtype}`);
  const text = atob(bdata);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  const count = bytes.length / size;
  if (LITTLE_ENDIAN && size === 4) return new Float32Array(bytes.buffer);
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: count }, (_, i) =>
    size === 4 ? view.getFloat32(4 * i, true) : view.getFloat64(8 * i, true),
  );
}

/** Series as the server sends them, by signal, decoded. */
export type Series = Readonly<Record<string, Float32Array>>;

export const minimumOf = (signal: string) => `${signal}.minimum`;
export const maximumOf = (signal: string) => `${signal}.maximum`;
export const isExtreme = (key: string) => key.includes(".");

export function decodeSeries(encoded: Readonly<Record<string, EncodedArray>>): Series {
  return Object.fromEntries(Object.entries(encoded).map(([signal, array]) => [signal, decodeArray(array)]));
}

/** Series over several roads: the means by signal, beside them the extremes. */
export function decodeBand({ mean, minimum, maximum }: Readonly<Record<"mean" | "minimum" | "maximum", Readonly<Record<string, EncodedArray>>>>): Series {
  const named = (name: (signal: string) => string, encoded: typeof mean) => Object.fromEntries(Object.entries(decodeSeries(encoded)).map(([signal, values]) => [name(signal), values]));
  return { ...decodeSeries(mean), ...named(minimumOf, minimum), ...named(maximumOf, maximum) };
}
