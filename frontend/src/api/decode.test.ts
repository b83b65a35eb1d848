import { describe, expect, it } from "vitest";
import { decodeArray, decodeBand, decodeSeries, isExtreme, maximumOf, minimumOf } from "./decode";

const encode = (array: Float32Array) =>
  btoa(String.fromCharCode(...new Uint8Array(array.buffer, array.byteOffset, array.byteLength)));

describe("typed arrays", () => {
  it("come back bit by bit from float32", () => {
    const values = new Float32Array([0, -1.5, 3.25e-7, 8582.5]);
    expect(decodeArray({ dtype: "f4", bdata: encode(values) })).toEqual(values);
  });

  it("are lists as well", () => {
    expect(decodeArray([0.5, null])).toEqual(new Float32Array([0.5, NaN]));
  });

  it("over several roads have their extremes beside the means", () => {
    const encoded = (value: number) => ({ dtype: "f4", bdata: encode(new Float32Array([value])) }) as const;
    const series = decodeBand({
      mean: { time: encoded(7), force: encoded(2) },
      minimum: { force: encoded(1) },
      maximum: { force: encoded(5) },
    });
    expect(
      [series.time, series.force, series[minimumOf("force")], series[maximumOf("force")]].map((values) => values?.[0]),
    ).toEqual([7, 2, 1, 5]);
    expect(Object.keys(series).filter(isExtreme)).toHaveLength(2);
  });

  it("are decoded signal by signal", () => {
    const one = new Float32Array([1]);
    expect(decodeSeries({ time: { dtype: "f4", bdata: encode(one) } })).toEqual({ time: one });
  });
});
