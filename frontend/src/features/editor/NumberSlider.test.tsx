// @vitest-environment happy-dom
import { cleanup, fireEvent, render, screen } from "@testing-library/react";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { leavesOf } from "../../scenario/differences";
import { FORM } from "../../scenario/form.fixture";
import { NumberSlider } from "./NumberFieldRow";
import type { LeafState } from "./FieldFrame";

const height = leavesOf(FORM).find(({ pointer }) => pointer === "/road/bump/height");

const changes = { drag: vi.fn(), release: vi.fn(), commit: vi.fn(), reject: vi.fn(), clearInvalid: vi.fn() };

function slider(state: Partial<LeafState> = {}) {
  if (height?.kind !== "number") throw new Error("no number");
  const leaf = { value: 0.1, readOnly: false, changed: false, rejected: undefined, error: undefined, ...changes };
  render(<NumberSlider field={height} leaf={{ ...leaf, ...state }} label="Height" />);
  return screen.getByRole("slider");
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  cleanup();
  vi.useRealTimers();
  vi.clearAllMocks();
});

const pause = () => void vi.advanceTimersByTime(1000);

it("a change without a pointer, by key or assistive technology, ends with a pause", () => {
  const input = slider();
  fireEvent.pointerDown(input, { button: 0 });
  fireEvent.pointerUp(input);
  expect(changes.release).not.toHaveBeenCalled(); // pressed, not moved
  fireEvent.change(input, { target: { value: "3" } });
  expect(changes.drag).toHaveBeenCalledOnce();
  expect(changes.release).not.toHaveBeenCalled();
  pause();
  expect(changes.release).toHaveBeenCalledOnce();
});

it("a dragged slider ends with the pointer's release, and only once", () => {
  const input = slider();
  fireEvent.pointerDown(input, { button: 0 });
  fireEvent.change(input, { target: { value: "3" } });
  pause();
  expect(changes.release).not.toHaveBeenCalled();
  fireEvent.pointerUp(input);
  fireEvent.lostPointerCapture(input);
  pause();
  expect(changes.release).toHaveBeenCalledOnce();
});

it("a pointer that came from elsewhere, or a slider that is switched off, changes nothing", () => {
  fireEvent.pointerUp(slider());
  cleanup();
  const disabled = slider({ readOnly: true });
  fireEvent.pointerDown(disabled, { button: 0 });
  fireEvent.pointerUp(disabled);
  expect(changes.release).not.toHaveBeenCalled();
});
