import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { createTimer } from "./timer";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it("acts once when it rests, and not where it was stopped", () => {
  const action = vi.fn();
  const timer = createTimer(350, action);
  timer.start();
  vi.advanceTimersByTime(300);
  timer.start();
  vi.advanceTimersByTime(300);
  expect(action).toHaveBeenCalledTimes(0);
  vi.advanceTimersByTime(50);
  expect(action).toHaveBeenCalledTimes(1);
  timer.start();
  timer.stop();
  vi.advanceTimersByTime(1000);
  expect(action).toHaveBeenCalledTimes(1);
});
