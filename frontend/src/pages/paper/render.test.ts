import { describe, expect, it } from "vitest";
import type { MadeFigure } from "../../api/types";
import { PALETTES } from "../../plots/palettes";
import { bumpRange, drawn, legendOf } from "./Figures";

const HISTORY: MadeFigure = {
  data: [{ type: "scatter", name: "LV control", mode: "lines", line: { color: "#1C5FDF", dash: "solid" } }],
  layout: {
    xaxis: { title: { text: "Distance [m]" } },
    shapes: [
      { type: "rect", name: "Brake", x0: 20, x1: 100, fillcolor: "orange" },
      { type: "rect", name: "Bump", x0: 100, x1: 107, fillcolor: "blue" },
      { type: "line", name: "Static load", line: { color: "grey", dash: "dash" } },
    ],
  },
};
const OVER_SPEED: MadeFigure = {
  data: [{ type: "scatter", name: "95 % interval", fill: "toself", fillcolor: "pink", line: { width: 0 } }],
  layout: {},
};

describe("a figure the server has made", () => {
  it("says all it shows: lines, areas, stages, references", () => {
    expect(legendOf(HISTORY).map(({ name, fill }) => [name, fill])).toEqual([
      ["LV control", null],
      ["Brake", "orange"],
      ["Bump", "blue"],
      ["Static load", null],
    ]);
    expect(legendOf(OVER_SPEED)).toEqual([
      { name: "95 % interval", colour: "currentColor", dash: "solid", fill: "pink" },
    ]);
  });

  it("can be shown around the bump only, where there is one", () => {
    expect(bumpRange(HISTORY)).toEqual([92, 122]);
    expect(bumpRange(OVER_SPEED)).toBeNull();
    const look = { palette: PALETTES.dark, scheme: "dark", bumpOnly: true } as const;
    expect(drawn(HISTORY, look).layout.xaxis).toMatchObject({ range: [92, 122], color: PALETTES.dark.text });
    expect(drawn(OVER_SPEED, look).layout.xaxis).not.toHaveProperty("range");
  });
});
