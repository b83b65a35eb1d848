import { describe, expect, it } from "vitest";
import type { Strategy } from "../api/types";
import { cell, figureCsv } from "./saved";
import { paperFigure, sized } from "./paperFigure";
import type { Curves } from "./curves";
import { loadPanel } from "./template.fixture";

const template = loadPanel({ lv: "LV, control" });
const x = new Float32Array([0, 1, 2, 3, 4]);
const load = new Float32Array([0, -6000, -7000.5, 2000, 0]);
const curves: Curves = {
  series: { lv: { position: x, load } },
  sourceSeries: {},
  layers: [
    {
      name: "before the edit",
      series: { lv: { position: x.subarray(0, 3), load: load.subarray(0, 3) } },
      line: {},
      opacity: 0.6,
    },
  ],
  summaries: {},
  strategies: [{ id: "lv", colour: "#7CBEF9" } as Strategy],
  axis: "distance",
  range: [1, 3],
  live: false,
  runId: "ab12",
  coreVersion: "1.2.3",
};

describe("a figure for a paper", () => {
  it("has its width in millimetres, its font in points and the colours of light paper", () => {
    const figure = paperFigure(template, curves, { width: 88, font: 9 });
    expect([figure.width, figure.height]).toEqual([88, 67]); // two rows of names
    expect(paperFigure(template, { ...curves, layers: [] }, { width: 88, font: 9 }).height).toBe(63);
    expect(figure.layout.font).toMatchObject({ size: 12 });
    expect(figure.layout.xaxis).toMatchObject({ range: [1, 3], title: { text: "Position [m]" } });
    expect(figure.data.map(({ line }) => line.color)).toEqual(["#1C5FDF", "#1C5FDF"]);
  });

  it("says what curves over several roads are", () => {
    const below = (shown: Partial<Curves>) =>
      (
        paperFigure(template, { ...curves, ...shown }, { width: 88, font: 9 }).layout.xaxis as {
          title: { text: string };
        }
      ).title.text;
    expect(below({ roads: 10 })).toBe("Position [m]<br>Mean of 10 roads; range: minimum to maximum");
    expect(below({ roads: 10, minus: "Passive" })).toBe("Position [m]<br>Differences of the means of 10 roads");
    expect(figureCsv(template, { ...curves, roads: 10 }, "")).toContain(
      "\n# Mean of 10 roads; range: minimum to maximum\n",
    );
  });

  it("shows a pin's name as it stands: nothing of it is a link or a tag", () => {
    const name = '<a href="https://other.test">R&D</a>';
    const { data, layout } = paperFigure(
      template,
      { ...curves, layers: [{ name, series: curves.series, line: {}, opacity: 1 }], minus: name },
      { width: 88, font: 9 },
    );
    const texts = [...data.map((trace) => trace.name), (layout.yaxis as { title: { text: string } }).title.text];
    expect(texts.join()).not.toContain("<");
    expect(texts).toEqual([
      'LV, control, &lt;a href="https://other.test">R&amp;D&lt;/a>',
      "LV, control",
      'Load [kN], change against &lt;a href="https://other.test">R&amp;D&lt;/a>',
    ]);
  });

  it("is as wide wherever it is placed", () => {
    expect(sized('<svg class="main-svg" width="333" height="238"><g width="5"/></svg>', 88, 63)).toBe(
      '<svg width="88mm" height="63mm" viewBox="0 0 333 238" class="main-svg"><g width="5"/></svg>',
    );
  });
});

describe("a figure's table", () => {
  it("says where it comes from and holds the curves shown, with those before the edit", () => {
    expect(figureCsv(template, { ...curves, range: [2, 3] }, "http://lab/?x=1").split("\n")).toEqual([
      "# Ridelab: Load [kN]",
      "# run: ab12",
      "# core: 1.2.3",
      "# scenario: http://lab/?x=1",
      '"LV, control, before the edit: position [m]","LV, control, before the edit: Load [kN]","LV, control: position [m]","LV, control: Load [kN]"',
      "1,-6,1,-6",
      "2,-7.0005,2,-7.0005",
      ",,3,2",
      "",
    ]);
  });
});

it("Nothing of a pin's name is a line or a formula of its own in a table", () => {
  const pinned = (name: string) =>
    figureCsv(
      template,
      { ...curves, layers: [{ name, series: curves.series, line: {}, opacity: 1 }], minus: name },
      "",
    ).split("\n");
  const lines = pinned('x\r\n=HYPERLINK("https://other.test");@SUM(1)\u2028,+1');
  expect(lines[0]).toBe(`# Ridelab: Load [kN], change against x =HYPERLINK("https://other.test");'@SUM(1) ,'+1`);
  expect(lines).toHaveLength(pinned("x").length);
  expect(lines[4]).toContain(`"LV, control, x =HYPERLINK(""https://other.test"");'@SUM(1) ,'+1: Load [kN]"`);
  expect([cell("=1+1"), cell("-5"), cell(" @a"), cell("a;b"), cell("\t=1")]).toEqual([
    "'=1+1",
    "'-5",
    " '@a",
    '"a;b"',
    " '=1",
  ]);
});
