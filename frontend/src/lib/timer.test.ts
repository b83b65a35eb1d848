import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { createTimer } from "./timer";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it("acts once when it rests, or at once when it is flushed", () => {
  const action = vi.fn();
  const timer = createTimer(350, action);
  timer.start();
  vi.advanceTimersByTime(300);
  timer.start();
  vi.advanceTimersByTime(300);
  expect(action).toHaveBeenCalledTimes(0);
  timer.flush();
  expect(action).toHaveBeenCalledTimes(1);
  vi.advanceTimersByTime(1000);
  timer.flush();
  expect(action).toHaveBeenCalledTimes(1);
  timer.start();
  vi.advanceTimersByTime(350);
  timer.flush();
  expect(action).toHaveBeenCalledTimes(2);
});
