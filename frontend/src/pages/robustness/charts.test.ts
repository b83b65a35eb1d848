import { expect, it } from "vitest";
import type { BatchSummary, Strategy } from "../../api/types";
import { ON_PAPER } from "../../plots/palettes";
import { spreadChart } from "./charts";

const figure = {
  key: "bump.body_acceleration.peak",
  label: "Body acceleration",
  group: "Peak, bump",
  unit: "mm",
  scale: 1000,
};
const TITLE = "Body acceleration, peak, bump [mm]";

it("The spread's file has a row and a bar for each strategy, in the page's units", () => {
  const results = { nominal: 0.002, highest: { value: 0.009 }, quantiles: [0.001, 0.002, 0.003, 0.004, 0.005] };
  const summary = {
    quantiles: [5, 25, 50, 75, 95],
    strategies: { lv: { figures: { [figure.key]: results } } },
  } as unknown as BatchSummary;
  const { figure: drawn, table } = spreadChart(
    summary,
    [
      { id: "lv", label: "LV control" },
      { id: "lqr", label: "LQR" },
    ] as unknown as Strategy[],
    figure,
    ON_PAPER,
  );
  expect(table?.at(-1)).toEqual(["LV control", 2, 1, 2, 3, 4, 5, 9]);
  expect(table?.[0]?.[1]).toBe(`Nominal: ${TITLE}`);
  expect(drawn.data.map((trace) => trace.x)).toEqual([[1, 5, null], [2, 4, null], [3], [2], [9]]);
  expect(drawn.layout).toMatchObject({ yaxis: { ticktext: ["LV control"] } });
});
