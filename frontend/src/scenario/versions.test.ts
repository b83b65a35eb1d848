import { expect, it } from "vitest";
import { upgraded } from "./versions";

it("A scenario stored by core 0.3.0 has a filter that knew no preview, one of today says so itself", () => {
  const kalman = { estimation: { kind: "kalman" } };
  expect(upgraded(kalman, 1)).toEqual({ estimation: { kind: "kalman", knows_preview: false } });
  expect(upgraded({}, 1)).toEqual({ estimation: { knows_preview: false } });
  expect(upgraded({ estimation: { knows_preview: true } }, 1)).toEqual({ estimation: { knows_preview: true } });
  expect(upgraded(kalman, 2)).toBe(kalman);
});
