import { expect, test } from "vitest";
import type { Summary } from "../../api/types";
import CASES from "../../../../tests/data/requirement_cases.json";
import { judgedHere } from "./judged";

test.each(CASES)("as the service judges one road: $case", ({ summaries, requirements, baseline, results }) => {
  const judged = judgedHere(summaries as unknown as Readonly<Record<string, Summary>>, requirements, baseline);
  expect(judged).toEqual(results.map((each) => expect.objectContaining(each) as unknown));
});
