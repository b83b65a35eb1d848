import { describe, expect, it } from "vitest";
import type { Paper, PaperCell } from "../../api/types";
import { isMissed, previewSentence, uncertain, wordOf } from "./Verdict";

const CELL: PaperCell = {
  table: 7,
  window: "rough_road",
  signal: "body_acceleration",
  statistic: "rms",
  strategy: "lv",
  against: "speed_only",
  paper_value: 0.57,
  paper_base: 0.83,
  paper_change: -31.3,
  misprint: null,
  our_value: 0.2,
  our_base: 0.3,
  our_factor: 1,
  our_change: -33.3,
  ci: [-35, -31.6],
  verdict: "reached",
  certain: true,
  without_preview: { our_change: 2, ci: [1, 3], verdict: "contradicts", certain: true },
};

const UNAVAILABLE = { our_change: null, ci: null, verdict: "unavailable", certain: null } as const;

function paper(preview: string, reached: number, without: number): Paper {
  return {
    core_version: "1",
    seeds: 20,
    first_seed: 1,
    interpretation: null,
    interpretations: [],
    absolutes: { rows: [], distances: [] },
    simulated: { reached: 0, total: 40 },
    ecu: { reached: 0, total: 8 },
    agreement: { cells: 40, within: 0, in_interval: 0 },
    reached,
    total: 48,
    counts: { reached, smaller: 48 - reached, contradicts: 0 },
    unavailable: null,
    complete: true,
    progress: { done: 300, total: 300 },
    without_preview: { reached: without, counts: { reached: without, smaller: 48 - without, contradicts: 0 } },
    scenario: {},
    cells: [CELL, { ...CELL, certain: false, without_preview: null }],
    readings: [
      {
        id: "preview",
        title: "Road preview",
        description: "",
        chosen: preview,
        choices: [
          { id: "lookahead", label: "Road ahead", default: true, source: "ours" },
          { id: "none", label: "None", default: false, source: "ours" },
        ],
      },
    ],
    rules: {},
    tables: [],
    errata: [],
  };
}

describe("what the claim hinges on", () => {
  it("is preview where the count falls without it", () => {
    const sentence = previewSentence(paper("lookahead", 36, 16));
    expect(sentence).toContain("With preview (road ahead) 36 of 48 cells are reached, without it 16: the claim hinges");
    expect(sentence).toContain("1 verdict changes.");
  });

  it("is not said to be preview where the count stays, or where there is none", () => {
    expect(previewSentence(paper("lookahead", 16, 16))).toContain("does not hinge");
    expect(previewSentence(paper("none", 16, 16))).not.toContain("hinge");
  });
});

it("counts the verdicts an interval leaves open", () => {
  expect(uncertain(paper("lookahead", 36, 16))).toBe(1);
});

it("takes what is pending neither for missed nor for uncertain", () => {
  const cell: PaperCell = { ...CELL, ...UNAVAILABLE, verdict: "pending", our_value: null, our_base: null };
  expect([uncertain({ ...paper("lookahead", 0, 0), cells: [cell] }), isMissed(cell), wordOf(cell.verdict)]).toEqual([
    0,
    false,
    "pending",
  ]);
});

it("takes what is not available neither for missed nor for uncertain", () => {
  const cell: PaperCell = { ...CELL, ...UNAVAILABLE, our_value: null, without_preview: UNAVAILABLE };
  const withErrata: Paper = {
    ...paper("lookahead", 28, 12),
    cells: [cell],
    unavailable: { cells: 1, reason: "There is no C compiler" },
  };
  expect([uncertain(withErrata), isMissed(cell), wordOf(cell.verdict)]).toEqual([0, false, "not available"]);
  expect(previewSentence(withErrata)).toContain("Without it 0 verdicts change.");
});
