import { describe, expect, it } from "vitest";
import { ApiProblem, Unreachable, isNotFound, isTransient, readProblem } from "./problem";

describe("problems", () => {
  it("are read with their places", () => {
    const problem = readProblem(
      422,
      { title: "t", detail: "d", errors: [{ pointer: "/a", message: "m" }, { pointer: 1 }] },
      null,
    );
    expect(problem).toMatchObject({
      status: 422,
      message: "d",
      errors: [{ pointer: "/a", message: "m" }],
      retryAfter: null,
    });
  });

  it("have a message whatever was answered", () => {
    expect(readProblem(500, undefined, null).message).toBe("The server answered 500");
    expect(readProblem(503, "<html>", "7").retryAfter).toBe(7);
  });

  it("know what may pass by itself", () => {
    expect(isTransient(new Unreachable())).toBe(true);
    expect([429, 503].every((status) => isTransient(new ApiProblem(status, "", [])))).toBe(true);
    expect([404, 422, 500].some((status) => isTransient(new ApiProblem(status, "", [])))).toBe(false);
    expect(isTransient(readProblem(503, { type: "urn:problem-type:ridelab:full" }, "7"))).toBe(true);
    expect(isNotFound(new ApiProblem(404, "", []))).toBe(true);
  });
});
