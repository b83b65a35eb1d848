import { expect, test } from "vitest";
import { FORM } from "../../scenario/form.fixture";
import type { Scenario } from "../../api/types";
import { faultsOf } from "./upload";

const PYDANTIC = "Input should be less than or equal to 1";
const fault = (pointer: string, scenario: Scenario, message = PYDANTIC) =>
  faultsOf(FORM, scenario, [{ pointer: `/scenario${pointer}`, message }])[0];

test.each([
  [
    "/road/bump/height",
    { road: { bump: { height: 5 } } },
    "Bump height: Must be from −100 to 100\u00a0cm; the file has 500\u00a0cm",
  ],
  ["/road/bump/height", { road: { bump: { height: "high" } } }, "Bump height: Must be a number, in m"],
  ["/road/seed", { road: { seed: 1.5 } }, "Road seed: Must be a whole number"],
  [
    "/road/bump/shape",
    { road: { bump: { shape: "round" } } },
    "Bump shape: Must be one of Cosine (cosine), Flat top (flat_top)",
  ],
  ["/mpc/weights/1", { mpc: { weights: [1, 2000] } }, "MPC cruise, pitch: Must be from 0 to 1000; the file has 2000"],
  ["/mpc/weights", { mpc: { weights: [1] } }, "Cruise: Needs 2 numbers"],
  ["/road", { road: 3 }, "Road: Needs its fields by name, in braces"],
])("what is wrong at %s is said by the form's names and in its units", (pointer, scenario, said) => {
  expect(fault(pointer, scenario)).toBe(said);
});

test("what the form cannot see stays as the server says it", () => {
  expect(fault("/road/seed", { road: { seed: 2 } }, "Too many roads")).toBe("Road seed: Too many roads");
  expect(fault("/road/colour", { road: { colour: 1 } }, "Unknown field colour")).toBe(
    "road.colour: Unknown field colour",
  );
  expect(fault("", {}, "This has to be a JSON object")).toBe("This has to be a JSON object");
});
