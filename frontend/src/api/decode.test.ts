import { describe, expect, it } from "vitest";
import { decodeArray, decodeBand, decodeSeries, isExtreme, maximumOf, minimumOf } from "./decode";
import { decodeLive } from "./client";

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

  it("of a run under a moving slider follow its JSON", () => {
    const head = {
      core_version: "1",
      scenario: { é: 1 },
      strategies: {
        lv: { status: "ok", series: { signals: ["time", "speed"], samples: 2 } },
        refused: { status: "failed", reason: "no" },
        lqr: { status: "ok", series: { signals: ["time", "speed"], samples: 1 } },
      },
    };
    const text = new TextEncoder().encode(JSON.stringify(head));
    const padded = Math.ceil(text.length / 4) * 4;
    const content = new Uint8Array(4 + padded + 4 * 6).fill(32);
    content.set(new Uint8Array(Uint32Array.of(padded).buffer));
    content.set(text, 4);
    content.set(new Uint8Array(Float32Array.of(0, 1, 7, 8, 0.5, 9).buffer), 4 + padded);
    const { series, strategies } = decodeLive(content.buffer);
    expect(series).toEqual({
      lv: { time: Float32Array.of(0, 1), speed: Float32Array.of(7, 8) },
      lqr: { time: Float32Array.of(0.5), speed: Float32Array.of(9) },
    });
    expect(strategies.refused).toMatchObject({ reason: "no" });
  });
});
