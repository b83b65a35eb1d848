import { describe, expect, it } from "vitest";
import type { Link, Summary } from "../api/types";
import { DEFAULT_VIEW } from "./address";
import type { ResultView } from "./resultView";
import { readSharedView, viewToShare } from "./sharing";

const summary = {} as Summary;
const run = {
  id: "x",
  core_version: "1",
  scenario: {},
  strategies: { lv: summary, lqr: summary, passive: summary },
  over: null,
};
const read = (view: Link["view"]) => readSharedView({ view, run });

describe("a link's view", () => {
  it("shows all of the run where it says nothing", () => {
    expect(read({})).toEqual({ view: DEFAULT_VIEW, strategies: ["lv", "lqr", "passive"], at: null });
  });

  it("is what was shared", () => {
    const resultView = {
      summaries: run.strategies,
      ids: ["lv", "passive"],
      baseline: "lv",
      axis: "time",
      reference: null,
      differences: false,
      pins: [{ name: "Soft", shown: { runId: "s" } }],
      zoom: [1, 2.5],
      whole: [0, 9],
      range: [1, 2.5],
    } as unknown as ResultView;
    const shared = viewToShare(resultView, 2, { strategy: "lv", position: 31.5 });
    expect(shared).toEqual({
      strategies: ["lv", "lqr", "passive"],
      hidden: ["lqr"],
      baseline: "lv",
      axis: "time",
      zoom: [1, 2.5],
      cursor: 2,
      instant: { strategy: "lv", position: 31.5 },
      pins: [{ name: "Soft", run: "s" }],
    });
    expect(read(shared)).toEqual({
      view: {
        ...DEFAULT_VIEW,
        axis: "time",
        baseline: "lv",
        hidden: ["lqr"],
        zoom: [1, 2.5],
        instant: { strategy: "lv", position: 31.5 },
      },
      strategies: ["lv", "passive"],
      at: 2,
    });
  });

  it("follows the bump where it was shown as the page opens", () => {
    const whole = [0, 9];
    const opened = (range: readonly number[]) =>
      viewToShare(resultView({ reference: null, zoom: null, whole, range }), null, null);
    expect(opened([1, 2.5])).not.toHaveProperty("zoom");
    expect(read(opened([1, 2.5])).view.zoom).toBeNull();
    expect(opened(whole)).toMatchObject({ zoom: null });
  });

  const pin = { name: "Soft", shown: { runId: "s" } };
  const before = { name: "before the last edit", shown: { runId: "b" } };
  const resultView = (compared: object) =>
    ({
      summaries: run.strategies,
      ids: ["lv"],
      pins: [pin],
      before,
      differences: true,
      ...compared,
    }) as unknown as ResultView;

  it("is against the pin or the baseline it was shared with, differences too", () => {
    const toPin = viewToShare(resultView({ reference: pin }), null, null);
    expect(toPin).toMatchObject({ reference: "s", differences: true });
    expect(read(toPin).view).toMatchObject({ reference: "pin:s", differences: true });
    expect(read(viewToShare(resultView({ reference: null }), null, null)).view).toMatchObject({
      reference: "baseline",
      differences: true,
    });
  });

  it("leaves out the state before the last edit, which a reader has not", () => {
    const view = viewToShare(resultView({ reference: before }), null, null);
    expect(view).not.toHaveProperty("reference");
    expect(read(view).view).toMatchObject({ reference: "baseline", differences: false });
  });

  it("never names what the run has not", () => {
    expect(read({ strategies: ["speed_only", "lv"], zoom: null }).strategies).toEqual(["lv"]);
  });
});
