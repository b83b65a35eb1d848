// @vitest-environment happy-dom
import { cleanup, render } from "@testing-library/react";
import { createElement } from "react";
import { describe, expect, it } from "vitest";
import type { ComparedPoint } from "../../api/types";
import { ChangeOf, gainsOf, priceText } from "./ValidationTable";

const point = (
  training: number,
  validation: number,
  verdict: "better" | "worse" | "unclear",
  roles = ["best.0"],
): ComparedPoint => ({
  trial: 7,
  roles,
  weights: {},
  failures: [],
  verdict: [verdict],
  training: {
    "objectives.0": { mean: 1, quantile: null, worst: 1, change: { value: training, low: null, high: null } },
  },
  fresh: {
    "objectives.0": {
      mean: 1,
      quantile: null,
      worst: 1,
      change: { value: validation, low: validation - 1, high: validation + 1 },
    },
  },
});
const paper: ComparedPoint = { ...point(0, 0, "unclear", ["paper"]), trial: 0, verdict: null };
const gains = (best: ComparedPoint) => gainsOf({ batch: "b", figures: [], points: [paper, best] }, 1);

describe("a gain on validation roads", () => {
  it.each([
    [point(-20, -19, "better"), "keeps"],
    [point(-20, -12, "better"), "shrinks"],
    [point(-20, -0.4, "unclear"), "unclear"],
    [point(-20, 3, "worse"), "worse"],
    [point(0, 0, "unclear"), "none"],
  ] as const)("is told: %#", (best, keeps) => expect(gains(best).map((gain) => gain.keeps)).toEqual([keeps]));

  it("says both changes and the interval", () => {
    expect(gains(point(-20, -12, "better"))[0]?.text).toBe(
      "−20.0\u2009% on the training roads, −12.0\u2009% (−13.0\u2009% to −11.0\u2009%) on the validation roads: less of the gain is left there.",
    );
  });

  it("says what got worse for it, the largest first", () => {
    const worse = (value: number) => ({
      mean: 1,
      quantile: null,
      worst: 1,
      change: { value, low: value - 1, high: value + 1 },
    });
    const dear = point(-20, -19, "better");
    const [gain] = gains({ ...dear, fresh: { ...dear.fresh, tyre: worse(20), pitch: worse(30), body: worse(0.5) } });
    expect(gain && priceText(gain, (key) => key)).toBe("Worse for it: pitch +30.0\u2009%, tyre +20.0\u2009%.");
    expect(priceText({ keeps: "keeps", worse: [] }, String)).toBe("Nothing else is worse for sure.");
  });

  it("is none where the paper's weights are the best themselves", () => {
    expect(
      gainsOf({ batch: "b", figures: [], points: [{ ...paper, roles: ["paper", "best.0"] }] }, 1).map(
        ({ keeps }) => keeps,
      ),
    ).toEqual(["none"]);
  });

  it("says nothing of what was not compared", () => {
    expect(gainsOf({ batch: "b", figures: [], points: [paper] }, 1)).toEqual([]);
  });
});

it.each([
  [-4, -6, -2, "▼ −4.0\u2009%, better"],
  [4, 2, 6, "▲ +4.0\u2009%, worse"],
  [-1, -3, 1, "≈ −1.0\u2009%, no certain difference"],
  [-1, null, null, "≈ −1.0\u2009%, no certain difference"],
] as const)("a change of %s %% between %s and %s is read out with its verdict", (value, low, high, text) => {
  const figure = { mean: 1, quantile: null, worst: 1, change: { value, low, high } };
  expect(render(createElement(ChangeOf, { figure })).container.firstElementChild?.textContent).toBe(text);
  cleanup();
});
