// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { render, screen } from "@testing-library/react";
import { createElement, type ComponentProps } from "react";
import { expect, it } from "vitest";
import type { Trial } from "../../api/types";
import { PointTable } from "./PointsTable";

it("a selected point strikes through those of the paper's weights that differ", () => {
  const items = ["Body", "Pitch", "Travel"].map((title, index) => ({ title, pointer: `/lqr/weights/${index}` }));
  const trial = { number: 3, weights: { "lqr.weights": [1, 5, 3] } } as unknown as Trial;
  const parts = {
    tuning: { paper: { number: 0, weights: { "lqr.weights": [1, 2, 3] } } },
    objectives: [],
    limits: [],
    tunable: {
      triples: [{ pointer: "/lqr/weights", title: "Weights", items }],
      others: [],
      preview: null,
      untuned: [],
    },
  } as unknown as ComponentProps<typeof PointTable>;
  render(createElement(PointTable, { ...parts, trial }), { wrapper: MantineProvider });
  const cell = screen
    .getByRole("table", { name: "Values of the selected point" })
    .querySelector("[data-weights='lqr.weights']");
  expect(cell?.textContent).toBe("1 · 5 · 31 · 2 · 3");
  expect([...(cell?.querySelectorAll("s") ?? [])].map((each) => each.textContent)).toEqual(["2"]);
});
