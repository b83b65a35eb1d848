// @vitest-environment happy-dom
import { act, renderHook } from "@testing-library/react";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { useCalm } from "./useCalm";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it("follows at once, but a few times a second while something moves, and never stays behind", () => {
  const { result, rerender } = renderHook(({ value, moving }) => useCalm(value, moving), {
    initialProps: { value: 0, moving: false },
  });
  rerender({ value: 1, moving: false });
  expect(result.current).toBe(1);
  const seen = new Set<number>();
  for (let value = 2; value <= 61; value++) {
    rerender({ value, moving: true });
    act(() => void vi.advanceTimersByTime(1000 / 60));
    seen.add(result.current);
  }
  expect(seen.size).toBeGreaterThan(4);
  expect(seen.size).toBeLessThan(11);
  act(() => void vi.advanceTimersByTime(1000));
  expect(result.current).toBe(61);
  rerender({ value: 62, moving: true });
  rerender({ value: 63, moving: false });
  expect(result.current).toBe(63);
});
