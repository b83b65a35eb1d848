import { expect, it } from "vitest";
import { ApiProblem, Unreachable } from "../../api/problem";
import { missingText } from "./useCompared";

it("A pin that is not shown says why", () => {
  expect(
    [null, new ApiProblem(404, "Not found", []), new Unreachable(), new ApiProblem(500, "Not now", [])].map(
      missingText,
    ),
  ).toEqual([
    "loading",
    "no longer stored on the server",
    "the server does not answer",
    "could not be loaded: Not now",
  ]);
});
