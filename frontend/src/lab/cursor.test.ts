import { expect, it } from "vitest";
import { cursor } from "./cursor";

it("Where somebody points in seconds is no place in metres", () => {
  cursor.set("time", 3);
  expect([cursor.get("time"), cursor.get("distance")]).toEqual([3, null]);
  cursor.set("distance", 100);
  expect([cursor.get("time"), cursor.get("distance")]).toEqual([null, 100]);
  cursor.set("distance", null);
  expect(cursor.get("distance")).toBeNull();
});
