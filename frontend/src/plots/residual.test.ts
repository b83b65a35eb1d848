import { describe, expect, it } from "vitest";
import { differences } from "./residual";

const numbers = (...values: number[]) => new Float32Array(values);
const now = { lv: { time: numbers(0, 1, 2), position: numbers(0, 10, 20), speed: numbers(5, 7, 9) } };

describe("curves as differences", () => {
  it("are taken at the same place, whatever the samples", () => {
    const before = { lv: { time: numbers(0, 2, 4), position: numbers(0, 5, 20), speed: numbers(1, 2, 5) }, lqr: {} };
    const { lv } = differences(now, before, "distance");
    expect([...(lv?.speed ?? [])]).toEqual([4, 4, 4]);
    expect([...(lv?.position ?? [])]).toEqual([0, 10, 20]);
    expect([...(differences(now, before, "time").lv?.speed ?? [])]).toEqual([4, 5.5, 7]);
  });

  it("are zero against itself, and there are none of what only one has", () => {
    expect([...(differences(now, now, "time").lv?.speed ?? [])]).toEqual([0, 0, 0]);
    expect(differences(now, { passive: now.lv }, "time")).toEqual({});
  });
});
