import { expect, it } from "vitest";
import type { JsonObject } from "../api/types";
import { unusedText, type Reading } from "./effect";
import type { Pointer } from "./path";
import { readSchema } from "./schema";
import { completed } from "./differences";

const number = (title: string, value = 0): JsonObject => ({
  type: "number",
  minimum: 0,
  maximum: 9,
  default: value,
  title,
  unit: "1",
});
const choice = (title: string, ...options: string[]): JsonObject => ({
  enum: options,
  default: options[0] ?? "",
  title,
});
const part = (title: string, properties: JsonObject): JsonObject => ({ type: "object", title, properties });
const form = readSchema(
  part("Scenario", {
    road: part("Road", {
      height: number("Height", 1),
      shape: choice("Shape", "round", "flat"),
      length: number("Length", 9),
      bump: part("Bump", {
        start: number("Position", 5),
        width: number("Width", 1),
        count: number("Bumps", 2),
        spacing: number("Spacing", 3),
      }),
    }),
    speed: part("Speed", { target: number("Target") }),
    state: part("State estimation", { kind: choice("State", "exact", "kalman"), noise: number("Noise") }),
    mpc: part("MPC", { preview: choice("Preview", "lookahead", "none"), weight: number("Weight") }),
    own: part("Own", { mine: part("Mine", { preview: choice("Mine: preview", "none", "lookahead") }) }),
    ecu: part("ECU", { bits: number("Bits"), delay: number("Delay") }),
  }),
);

const is = (field: string, ...values: (string | number)[]) => ({ field, values, excluded: false });
const always = { fields: ["road.height"], conditions: [] };
const shape = { fields: ["road.shape"], conditions: [{ field: "road.height", values: [0], excluded: true }] };
const noise = { fields: ["state.noise"], conditions: [is("state.kind", "kalman")] };
const both = { fields: ["ecu.delay"], conditions: [is("state.kind", "kalman"), is("mpc.preview", "lookahead")] };
const mpc = { fields: ["mpc"], conditions: [] };
const target = { fields: ["speed.target"], conditions: [{ field: "road.has_bump", values: [true], excluded: false }] };
const LV: Reading = { id: "lv", label: "LV", reads_when: [always, shape, noise, mpc, both, target] };
const ECU: Reading = { id: "ecu", label: "ECU", reads_when: [always, shape, mpc, { fields: ["ecu"], conditions: [] }] };
const PASSIVE: Reading = { id: "passive", label: "Passive", reads_when: [always, shape] };
const strategies = [LV, ECU, PASSIVE];

const say = (pointer: Pointer, on: readonly string[], scenario = {}, all = strategies) =>
  unusedText({ form, scenario: { ...completed(form, scenario), own: {} } }, pointer, { strategies: all, on });

it("a field that no shown strategy uses says who does, as strategies come and go", () => {
  expect(say("/mpc/weight", ["passive"])).toBe("No shown strategy uses this. LV and ECU do.");
  expect(say("/ecu/bits", ["lv", "passive"])).toBe("No shown strategy uses this. ECU does.");
  expect(say("/ecu/bits", ["lv", "ecu"])).toBeNull();
  expect(say("/road/height", ["passive"])).toBeNull();
  expect(say("/mpc/weight", [])).toBeNull();
  expect(say("/mpc/weight", ["recording:a"])).toBeNull();
  expect(say("/road/shape", [], { road: { height: 0 } })).toBe("Without effect with Height: 0");
  expect(say("/state/noise", [])).toBe("Used only with State: Kalman");
  const many = ["A", "B", "C", "D", "E"].map((label) => ({ ...ECU, id: label, label }));
  expect(say("/ecu/bits", ["lv"], {}, [LV, ...many])).toBe("No shown strategy uses this. A, B, C and 2 more do.");
});

it("what only a bump on the road gives an effect says so, as the bump and the road's end move", () => {
  expect(say("/speed/target", ["lv"])).toBeNull();
  const road = (length: number, start: number) => ({
    road: { length, bump: { start, width: 1, count: 2, spacing: 3 } },
  });
  expect(say("/speed/target", ["lv"], road(9, 5.5))).toBe("Used only with a bump that ends on the road");
  expect(say("/speed/target", ["lv"], road(9.5, 5.5))).toBeNull();
});

it("a field that other values leave without effect says which, as they change", () => {
  expect(say("/state/noise", ["lv", "passive"])).toBe("Used only with State: Kalman");
  expect(say("/state/noise", ["lv"], { state: { kind: "kalman" } })).toBeNull();
  expect(say("/state/noise", ["passive"], { state: { kind: "kalman" } })).toBe("No shown strategy uses this. LV does.");
  expect(say("/state/noise", ["passive"])).toBe("Used only with State: Kalman, by LV.");
  const hooks = ["Sky", "Ground", "Hybrid"].map((label) => ({ ...LV, id: label, label }));
  expect(say("/state/noise", ["passive"], {}, [...hooks, PASSIVE])).toBe(
    "Used only with State: Kalman, by Sky, Ground and Hybrid.",
  );
  const other: Reading = { ...ECU, reads_when: [{ ...noise, conditions: [is("mpc.preview", "none")] }] };
  expect(say("/state/noise", ["passive"], {}, [LV, other, PASSIVE])).toBe(
    "No shown strategy uses this. LV and ECU do.",
  );
  const high = { ...LV, reads_when: [shape] };
  const flat = { road: { height: 0 } };
  expect(say("/road/shape", ["ecu"], flat, [high, { ...ECU, reads_when: [] }])).toBe(
    "Without effect with Height: 0. Only LV uses this.",
  );
  const rough = { fields: ["road.shape"], conditions: [is("state.kind", "kalman")] };
  const either: Reading = { ...PASSIVE, reads_when: [rough, shape] };
  expect(say("/road/shape", ["passive"], { road: { height: 0 } }, [either])).toBe("Without effect with Height: 0");
  expect(say("/road/shape", ["passive"], { road: { height: 0 } })).toBe("Without effect with Height: 0");
  const ours = [LV, PASSIVE];
  expect(say("/ecu/delay", ["lv"], { mpc: { preview: "none" } }, ours)).toBe(
    "Used only with State estimation: Kalman and MPC preview: Lookahead",
  );
  expect(say("/ecu/delay", ["lv"], { state: { kind: "kalman" }, mpc: { preview: "none" } }, ours)).toBe(
    "Used only with MPC preview: Lookahead",
  );
});

it("one's own controller uses what the server says that it reads", () => {
  const own = (reads_when: Reading["reads_when"]): Reading => ({ id: "mine", label: "Mine", reads_when });
  const asked = [...strategies, own([always, { fields: ["state.noise"], conditions: [] }])];
  expect(say("/state/noise", ["lv", "mine"], {}, asked)).toBeNull();
  expect(say("/state/noise", ["lv", "mine"], {}, [...strategies, own([always])])).toBe("Used only with State: Kalman");
  const seeing = own([{ fields: ["state.noise"], conditions: [is("own.mine.preview", "none")] }]);
  expect(say("/state/noise", ["mine"], {}, [seeing])).toBeNull(); // the option's default, which no scenario has
});
