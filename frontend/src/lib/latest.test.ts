import { describe, expect, it } from "vitest";
import { createLatest } from "./latest";

interface Call {
  readonly body: number;
  readonly signal: AbortSignal;
  readonly answer: (value: string) => void;
  readonly fail: (error: Error) => void;
}

function harness(most = 1) {
  const calls: Call[] = [];
  const answers: string[] = [];
  const errors: string[] = [];
  const latest = createLatest<number, string>({
    run: (body, signal) =>
      new Promise((resolve, reject) => {
        calls.push({ body, signal, answer: resolve, fail: reject });
      }),
    onAnswer: (answer) => answers.push(answer),
    onError: (error) => errors.push(error instanceof Error ? error.message : ""),
    most,
  });
  const tick = () => new Promise((resolve) => setTimeout(resolve, 0));
  return { calls, answers, errors, latest, tick };
}

describe("one request at a time, the newest next", () => {
  it("skips what was overtaken", async () => {
    const { calls, answers, latest, tick } = harness();
    for (const body of [1, 2, 3, 4]) latest.request(body);
    expect(calls.map(({ body }) => body)).toEqual([1]);
    calls[0]?.answer("one");
    await tick();
    expect(calls.map(({ body }) => body)).toEqual([1, 4]);
    calls[1]?.answer("four");
    await tick();
    expect(answers).toEqual(["one", "four"]);
  });

  it("has two under way, and an answer overtakes what was asked before it", async () => {
    const { calls, answers, latest, tick } = harness(2);
    for (const body of [1, 2, 3, 4]) latest.request(body);
    expect(calls.map(({ body }) => body)).toEqual([1, 2]);
    calls[1]?.answer("two");
    await tick();
    expect(calls.map(({ body }) => body)).toEqual([1, 2, 4]);
    expect(calls[0]?.signal.aborted).toBe(true);
    calls[0]?.answer("one");
    calls[2]?.answer("four");
    await tick();
    expect(answers).toEqual(["two", "four"]);
  });

  it("drops everything on cancel, also an answer that still comes", async () => {
    const { calls, answers, latest, tick } = harness();
    latest.request(1);
    latest.request(2);
    latest.cancel();
    expect(calls[0]?.signal.aborted).toBe(true);
    calls[0]?.answer("late");
    await tick();
    expect(answers).toEqual([]);
    expect(calls).toHaveLength(1);
  });

  it("goes on after an error", async () => {
    const { calls, answers, errors, latest, tick } = harness();
    latest.request(1);
    latest.request(2);
    calls[0]?.fail(new Error("no"));
    await tick();
    calls[1]?.answer("two");
    await tick();
    expect(errors).toEqual(["no"]);
    expect(answers).toEqual(["two"]);
  });
});
