import { describe, expect, it } from "vitest";
import { curlCommand } from "./curl";

it("quotes the scenario for a shell", () => {
  expect(curlCommand("http://h", { note: "it's" }, ["lv"])).toBe(
    `curl -sS http://h/api/v1/runs -H 'content-type: application/json' -d '{"scenario":{"note":"it'\\''s"},"strategies":["lv"]}'`,
  );
});

describe("the body", () => {
  it("is the API's own", () => {
    const command = curlCommand("", { a: 1 }, ["lv", "lqr"]);
    expect(JSON.parse(/-d '(.*)'$/.exec(command)?.[1] ?? "")).toEqual({ scenario: { a: 1 }, strategies: ["lv", "lqr"] });
  });
});
