// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { render, screen } from "@testing-library/react";
import { createElement } from "react";
import { expect, it } from "vitest";
import type { Attribution } from "../../api/types";
import { PALETTES } from "../../plots/palettes";
import type { Labels } from "../../server/useCatalogues";
import { EqualSpeed, sharesFigure } from "./Contributions";

const words = { signal: String, view: () => "peak, bump" } as unknown as Labels;

it("shares stack up to the whole gain, and left of zero where a part takes away", () => {
  const share = { window: "bump", signal: "jerk", statistic: "peak", total_change: -72 } as const;
  const shares = [
    { ...share, speed: 84, preview: 50, switching: -34 },
    { ...share, signal: "travel", speed: 50, preview: 30, switching: 20 },
  ];
  const { data, layout } = sharesFigure(shares, words, PALETTES.light);
  const bars = data as unknown as readonly { readonly x: readonly number[]; readonly y: readonly string[] }[];
  expect(bars.map(({ x }) => x)).toEqual([
    [84, 50],
    [50, 30],
    [-34, 20],
  ]);
  expect([0, 1].map((row) => bars.reduce((sum, { x }) => sum + (x[row] ?? 0), 0))).toEqual([100, 100]);
  expect(bars[0]?.y).toEqual(["jerk<br>peak, bump", "travel<br>peak, bump"]);
  expect(layout).toMatchObject({ barmode: "relative", shapes: [{ x0: 100, x1: 100 }] });
});

it("a pair without a cell of the first one's has nothing there", () => {
  const cell = { window: "bump", signal: "jerk", statistic: "peak", our_change: -4, ci: [-6, -2] };
  const pairs = [
    { label: "one", cells: [cell] },
    { label: "two", cells: [] },
  ] as unknown as Attribution["equal_speed"];
  render(createElement(EqualSpeed, { pairs, words }), { wrapper: MantineProvider });
  const rows = screen.getAllByRole("row").slice(-2);
  expect(rows.map((row) => row.textContent)).toEqual([expect.stringContaining("one▼ −4.0\u2009%, better"), "two"]);
});
