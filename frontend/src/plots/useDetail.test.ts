// @vitest-environment happy-dom
import { QueryClient, QueryClientProvider } from "@tanstack/react-query";
import { renderHook } from "@testing-library/react";
import { createElement, type PropsWithChildren } from "react";
import { createAtom } from "@tanstack/react-store";
import { expect, it, vi } from "vitest";
import type { FigureTemplate, OverRoads } from "../api/types";
import { figuresQuery, OVERVIEW_POINTS, seriesQuery } from "../server/queries";
import type { ResultView } from "../lab/resultView";
import type { Result } from "../lab/result";
import { settledCurves, shownCurves, type Curves } from "./curves";
import { useCurves, useDetail, useLayered } from "./useDetail";

const numbers = (...values: number[]) => new Float32Array(values);
const panel = (signal: string) => ({ layout: { meta: { signal } } }) as unknown as FigureTemplate;
const result = (runId: string, roads: number) =>
  ({
    runId,
    summaries: { lv: {} },
    series: { lv: { speed: numbers(1) } },
    missing: null,
    over: roads > 1 ? ({ roads } as OverRoads) : null,
  }) as unknown as Result;

const client = new QueryClient();
client.setQueryData(figuresQuery.queryKey, { road: panel("front_road"), speed: panel("speed") });
const means = { lv: { speed: numbers(2) } };
for (const id of ["ten", "before"])
  client.setQueryData(seriesQuery(id, ["lv"], OVERVIEW_POINTS, ["speed"]).queryKey, means);

vi.stubGlobal("fetch", () => new Promise(() => undefined)); // what is not there does not come

const wrapper = ({ children }: PropsWithChildren) => createElement(QueryClientProvider, { client }, children);
const used = <Value>(hook: () => Value): Value => renderHook(hook, { wrapper }).result.current;

it("beside means stand means, beside one road's curves one road's", () => {
  const resultView = {
    before: { name: "before", shown: result("before", 10) },
    pins: [
      { name: "one", shown: result("one", 1) },
      { name: "gone", shown: result("gone", 10) },
    ],
  };
  const beside = (shown: Result) => {
    const { before, pins } = used(() => useLayered({ shown, ...resultView }));
    return [before, ...pins].map((each) => each?.shown.series.lv?.speed?.[0]);
  };
  expect(beside(result("ten", 10))).toEqual([2, 1, 1]);
  expect(beside(result("one", 1))).toEqual([1, 1, 1]);
});

it("differences are those of the means where both have them over as many roads, else those of the first road", () => {
  const roads = (against: Result) => {
    const resultView = {
      shown: result("ten", 10),
      differences: true,
      reference: { name: "pin", shown: against },
    } as unknown as ResultView;
    const curves = used(() => useCurves(resultView));
    return [curves.own.shown.over?.roads, curves.other.shown.over?.roads, curves.roads];
  };
  const firstRoad = [undefined, undefined, undefined];
  expect([result("before", 10), result("before", 5), result("gone", 10), result("one", 1)].map(roads)).toEqual([
    [10, 10, 10],
    firstRoad,
    firstRoad,
    firstRoad,
  ]);
});

it("waits for finer samples where the range shown has few", () => {
  const waits = (runId: string | null) => {
    const series = { lv: { position: numbers(1, 2) } };
    const drawn = { shown: { ...result("one", 1), runId }, ids: ["lv"], series, axis: "distance", range: [1, 2] };
    return used(
      () => useDetail({ ...drawn, differences: false } as unknown as Parameters<typeof useDetail>[0]).waiting,
    );
  };
  expect([waits("one"), waits(null)]).toEqual([true, false]);
});

it("a picture is of what the panels draw once nothing is on its way, and of nothing where there are none", async () => {
  await expect(settledCurves()).rejects.toThrow("No plots are shown.");
  const source = createAtom({ runId: "old", waiting: true } as Curves);
  shownCurves.set(source);
  const curves = settledCurves();
  source.set({ runId: "between", waiting: true } as Curves);
  source.set({ runId: "new", waiting: false } as Curves);
  expect(await curves).toMatchObject({ runId: "new" });
  source.set({ runId: "refused", failure: new Error("Not now") } as Curves);
  await expect(settledCurves()).rejects.toThrow("Not now");
  source.set({ runId: "newer", waiting: true } as Curves);
  const unseen = settledCurves();
  shownCurves.set(null);
  await expect(unseen).rejects.toThrow("No plots are shown.");
});
