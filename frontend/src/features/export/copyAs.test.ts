import { describe, expect, it } from "vitest";
import { paperScenarioOf } from "../../scenario/differences";
import { FORM } from "../../scenario/form.fixture";
import { setAt } from "../../scenario/path";
import { asCommand, asCurl, asPython, changedPart } from "./copyAs";

const PAPER = paperScenarioOf(FORM);
const CHANGED = setAt(setAt(setAt(PAPER, "/road/bump/height", -0.06), "/mpc/weights/1", 3), "/mpc/lag", 20);
const copyRequest = (scenario = CHANGED) => ({
  origin: "http://h:8000",
  form: FORM,
  scenario,
  strategies: ["lv", "lqr"],
  roads: 1,
  baseline: null as string | null,
  requirements: [],
});

describe("what is written out", () => {
  it("is what differs from the paper, weights whole", () => {
    expect(changedPart(PAPER, FORM)).toEqual({});
    expect(changedPart(CHANGED, FORM)).toEqual({
      road: { bump: { height: -0.06 } },
      mpc: { lag: 20, weights: [8, 3] },
    });
  });
});

describe("curl", () => {
  it("sends the API's own body", () => {
    const command = asCurl(copyRequest());
    expect(command).toMatch(/^curl -sS http:\/\/h:8000\/api\/v1\/runs -H 'content-type: application\/json' -d '/);
    expect(JSON.parse(/-d '(.*)'$/.exec(command)?.[1] ?? "")).toEqual({
      scenario: changedPart(CHANGED, FORM),
      strategies: ["lv", "lqr"],
    });
  });

  it("is quoted for a shell", () => {
    expect(asCurl({ ...copyRequest(PAPER), strategies: ["it's"] })).toContain(`"strategies":["it'\\''s"]`);
  });
});

it("the command line sets field by field", () => {
  expect(asCommand(copyRequest())).toBe(
    "ridelab run --set road.bump.height=-0.06 --set mpc.lag=20 --set mpc.weights.1=3 --strategy lv,lqr --server http://h:8000",
  );
  expect(asCommand(copyRequest(PAPER))).toBe("ridelab run --strategy lv,lqr --server http://h:8000");
});

it("several roads and their baseline are written out", () => {
  const several = { ...copyRequest(PAPER), roads: 10, baseline: "lqr" };
  expect(asCurl(several)).toContain(`"strategies":["lv","lqr"],"roads":10,"baseline":"lqr"}`);
  expect(asCommand(several)).toContain("--strategy lv,lqr --roads 10 --baseline lqr");
  expect(asPython(several)).toContain(`ridelab.run(scenario, ["lv", "lqr"], roads=10, baseline="lqr")`);
});

it("a baseline that is hidden runs too", () => {
  const hidden = { ...copyRequest(PAPER), baseline: "skyhook" };
  expect(asCurl(hidden)).toContain(`"strategies":["lv","lqr","skyhook"],"baseline":"skyhook"}`);
  expect(asCommand(hidden)).toContain("--strategy lv,lqr,skyhook --baseline skyhook --server");
  const several = { ...copyRequest(PAPER), roads: 5, baseline: "passive" };
  expect(asPython(several)).toContain(`ridelab.run(scenario, ["lv", "lqr", "passive"], roads=5)`);
});

describe("Python", () => {
  it("uses the client", () => {
    expect(asPython(copyRequest())).toBe(`from ridelab import Ridelab

scenario = {"road": {"bump": {"height": -0.06}}, "mpc": {"lag": 20, "weights": [8, 3]}}
with Ridelab("http://h:8000") as ridelab:
    run = ridelab.run(scenario, ["lv", "lqr"])
`);
  });

  it("writes nothing as None, and breaks long lines", () => {
    const long = setAt(
      setAt(setAt(setAt(CHANGED, "/mpc/force_weight", 2e-9), "/road/seed", 7), "/road/bump/shape", "flat_top"),
      "/mpc/lag",
      5,
    );
    expect(asPython(copyRequest(long))).toContain(`scenario = {
    "road": {"seed": 7, "bump": {"shape": "flat_top", "height": -0.06}},
    "mpc": {"lag": 5, "force_weight": 2e-9, "weights": [8, 3]},
}
`);
  });
});

it("what is required goes along in each", () => {
  const requirements = [
    { metric: "travel_time", max: 12 },
    { metric: "bump.rear_tyre_load.peak", max_change: -20, strategies: ["lv"] },
  ];
  const request = { ...copyRequest(PAPER), requirements };
  expect(JSON.parse(/-d '(.*)'$/.exec(asCurl(request))?.[1] ?? "")).toMatchObject({ requirements });
  expect(asCommand(request)).toContain("--require 'travel_time<12' --require 'lv:bump.rear_tyre_load.peak<-20%'");
  expect(asPython(request)).toContain('requirements = [\n    {"metric": "travel_time", "max": 12},\n    {\n');
  expect(asPython(request)).toContain('["lv", "lqr"], requirements=requirements)');
});
