import { describe, expect, it } from "vitest";
import { maximumOf, minimumOf } from "../api/decode";
import type { SeriesByStrategy } from "../api/types";
import type { Axis } from "../lab/address";
import type { ResultView } from "../lab/resultView";
import type { FigureInput } from "./curves";
import { drawnOf } from "./differences";
import { stageShapes } from "./shapes";

const numbers = (...values: number[]) => new Float32Array(values);
const now = { lv: { time: numbers(0, 1, 2), position: numbers(0, 10, 20), speed: numbers(5, 7, 9) } };

const BEFORE = { shown: {}, name: "before" } as unknown as ResultView["reference"];
const resultView = (axis: Axis) => ({
  differences: true,
  reference: BEFORE,
  baseline: null,
  ids: ["lv"],
  axis,
  range: [0, 20] as const,
  summaries: {},
});
const differences = (own: SeriesByStrategy, other: SeriesByStrategy, axis: Axis) =>
  drawnOf(resultView(axis), own, other).series;

describe("curves as differences", () => {
  it("are taken at the same place, whatever the samples", () => {
    const before = { lv: { time: numbers(0, 2, 4), position: numbers(0, 5, 20), speed: numbers(1, 2, 5) }, lqr: {} };
    const { lv } = differences(now, before, "distance");
    expect([...(lv?.speed ?? [])]).toEqual([4, 4, 4]);
    expect([...(lv?.position ?? [])]).toEqual([0, 10, 20]);
    expect([...(differences(now, before, "time").lv?.speed ?? [])]).toEqual([4, 5.5, 7]);
  });

  it("of two thinned runs of the same motion are none: all samples are subtracted, then few are drawn", () => {
    const samples = Array.from({ length: 20_001 }, (_, index) => index);
    const motion = (time: number) => Math.sin(40 * time);
    const series = (indices: readonly number[]) => ({
      lv: {
        time: numbers(...indices.map((i) => i / 1000)),
        position: numbers(...indices.map((i) => i / 1000)),
        speed: numbers(...indices.map((i) => motion(i / 1000))),
      },
    });
    const [one, other] = [
      series(samples.filter((i) => i % 37 === 0 || i % 5000 < 40)),
      series(samples.filter((i) => i % 41 === 0 || i % 5000 < 40)),
    ];
    const all = series(samples);
    const between = (own: SeriesByStrategy, subtracted: SeriesByStrategy, range: readonly [number, number]) =>
      drawnOf({ ...resultView("distance"), range }, own, subtracted).series.lv?.speed;
    const largest = (values: Float32Array | undefined) => Math.max(...(values ?? [NaN]).map(Math.abs));
    expect(largest(between(one, other, [0, 20]))).toBeLessThan(1e-5); // where both have all samples, and nowhere else
    expect(between(one, other, [0, 20])).toHaveLength(40);
    expect(between(one, other, [7, 8])).toHaveLength(0);
    expect(largest(between(all, all, [0, 20]))).toBe(0);

    const bumped = { lv: { ...all.lv, speed: all.lv.speed.map((value, i) => (i === 7777 ? value + 3 : value)) } };
    const drawn = between(bumped, all, [0, 20]);
    expect(largest(drawn)).toBeCloseTo(3, 5);
    expect(drawn?.length).toBeLessThan(2000);
  });

  it("are zero against itself, and there are none of what only one has", () => {
    expect([...(differences(now, now, "time").lv?.speed ?? [])]).toEqual([0, 0, 0]);
    expect(differences(now, { passive: now.lv }, "time")).toEqual({});
  });

  it("are those of the means, without a band", () => {
    const over = { lv: { ...now.lv, [minimumOf("speed")]: numbers(4, 6, 8), [maximumOf("speed")]: numbers(6, 8, 10) } };
    expect(Object.keys(differences(over, now, "time").lv ?? {})).toEqual(["time", "position", "speed"]);
  });

  it("are shaded where the car itself braked", () => {
    const own = { lv: { ...now.lv, brake_pressure: numbers(0, 4e6, 4e6) } };
    const { series, sourceSeries } = drawnOf(resultView("time"), own, own);
    expect([...(series.lv?.brake_pressure ?? [])]).toEqual([0, 0, 0]);
    const stage = { stage: "brake", start_time: 0, end_time: 2, start_position: 0, end_position: 20 };
    const summaries = { lv: { stages: [stage] } } as unknown as FigureInput["summaries"];
    const template = {
      layout: { meta: { stage_fills: { brake: "orange" }, braking: 2e4 } },
    } as unknown as FigureInput["template"];
    const shapes = stageShapes({
      template,
      sourceSeries,
      summaries,
      strategies: [{ id: "lv", colour: "#123456" }],
      axis: "distance",
    });
    expect(shapes).toEqual([expect.objectContaining({ fillcolor: "orange", x0: 10, x1: 20 })]);
  });
});
