import { expect, it } from "vitest";
import type { FrequencyAnswer, Strategy } from "../../api/types";
import { PALETTES } from "../../plots/palettes";
import { frequencyFigures } from "./FrequencyCard";

const result = (magnitude: number[] | null): FrequencyAnswer["strategies"][string] => ({
  ...{ speed: 10, modes: null, margins: null, bands: null, reason: null },
  responses: magnitude && { body_acceleration: { magnitude, phase: magnitude.map(() => Math.PI) } },
  psd: magnitude && { weighted_body_acceleration: [0.01, 1] },
});
const ANSWER: FrequencyAnswer = {
  frequency: [1, 10],
  stage: "bump",
  bands: [[1, 2]],
  modes: [],
  strategies: { lv: result([1, 10]), passive: result([10, 10]), hook: result(null) },
};
const STRATEGIES = ["lv", "hook"].map((id) => ({ id, label: id, colour: "#123456", dash: "solid" }) as Strategy);

it("gains are in decibels, against passive too, over a logarithmic axis; what is not linear has no curve", () => {
  const figures = frequencyFigures(ANSWER, STRATEGIES, "body_acceleration", PALETTES.light);
  const drawn = Object.fromEntries(figures.map(({ title, figure }) => [title, figure.data.map(({ y }) => [...y])]));
  expect(drawn).toEqual({
    Gain: [[0, 20]],
    "Gain against passive": [[-20, 0]],
    Phase: [[180, 180]],
    "Spectrum on this road": [[-20, 0]],
  });
  expect([...(figures[0]?.figure.data[0]?.x ?? [])]).toEqual([0, 1]);
});
