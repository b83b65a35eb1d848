import { describe, expect, it } from "vitest";
import type { ChartFigure } from "./Chart";
import { asZoomed, chartCsv, paperChart } from "./paperChart";
import type { GridTrace, LineTrace, PointTrace } from "./plotly";

const layout = {
  shapes: [],
  margin: { r: 40 },
  xaxis: { title: { text: "Height [m]" } },
  yaxis: { title: { text: "Peak [m/s²]" } },
  annotations: [{ text: "25 km/h", font: { size: 11, color: "#000" } }],
};
const line: LineTrace = {
  type: "scatter",
  mode: "lines",
  name: "LQR",
  x: [1, 2, null],
  y: [3, 4, null],
  line: {},
  opacity: 1,
  hoverinfo: "skip",
};
const points = (name: string, x: number[], y: number[]): PointTrace => ({
  type: "scatter",
  mode: "markers",
  name,
  x,
  y,
  marker: {},
  customdata: [],
});
const sweep: ChartFigure = {
  data: [line, points("LQR", [1, 2], [3, 4.123456789]), points("Passive, car", [], []), points("Lowest", [1], [3])],
  layout,
};
const legend = ["LQR", "Passive, car"];
const cells: GridTrace = {
  type: "heatmap",
  name: "Peak",
  x: [1, 2],
  y: [10, 20],
  z: [
    [5, 6],
    [7, null],
  ],
};
const contour: GridTrace = { ...cells, type: "contour", name: "5.5" };
const map: ChartFigure = { data: [cells, contour], layout };

describe("a chart for a paper", () => {
  it("has its width in millimetres, its font in points, and each strategy with points once in its legend", () => {
    const { width, data, layout: page } = paperChart({ figure: sweep, legend }, { width: 88, font: 9 });
    expect(width).toBe(88);
    expect(page).toMatchObject({
      font: { size: 12 },
      paper_bgcolor: "#ffffff",
      margin: { r: 40 },
      xaxis: { title: { text: "Height [m]", font: { size: 12 } } },
      annotations: [{ text: "25 km/h", font: { size: 12, color: "#000" } }],
    });
    expect(data.map((trace) => "showlegend" in trace && trace.showlegend)).toEqual([false, true, false, false]);
  });

  it("says above it what colours stand for, in as many lines as it takes", () => {
    const titleAt = (width: number) =>
      (
        paperChart(
          { figure: map, legend: [], colours: "Body acceleration, peak, bump, change against Passive, LV control [%]" },
          { width, font: 8 },
        ).layout as { title?: { text: string } }
      ).title?.text;
    expect(titleAt(88)).toBe("Body acceleration, peak, bump,<br>change against Passive, LV control [%]");
    expect(titleAt(180)).not.toContain("<br>");
  });

  it("shows what somebody has zoomed to", () => {
    const drawn = {
      layout: { xaxis: { range: [1, 1.5], autorange: false }, yaxis: { range: [0, 9], autorange: true } },
    } as unknown as HTMLElement;
    const { xaxis, yaxis } = asZoomed(sweep, drawn).layout;
    expect(xaxis).toMatchObject({ range: [1, 1.5], title: { text: "Height [m]" } });
    expect(yaxis).toEqual(layout.yaxis);
    expect(asZoomed(sweep, null)).toEqual(sweep);
  });
});

describe("a chart's table", () => {
  it("has a row for each point of a strategy, and says where it comes from", () => {
    expect(chartCsv({ figure: sweep, legend }, ["Ridelab: Peak"]).split("\n")).toEqual([
      "# Ridelab: Peak",
      ",Height [m],Peak [m/s²]",
      "LQR,1,3",
      "LQR,2,4.123457",
      "",
    ]);
  });

  it("has the points of a line that joins no others, also where they are packed, and rows of its own where it has them", () => {
    const packed = {
      type: "scatter" as const,
      name: "Figure 14",
      x: [1, 2],
      y: { dtype: "f4", bdata: "AACAPwAAAEA=" },
    };
    expect(
      chartCsv({ figure: { data: [line, packed], layout }, legend: ["LQR", "Figure 14"] }, [])
        .split("\n")
        .slice(1),
    ).toEqual(["LQR,1,3", "LQR,2,4", "Figure 14,1,1", "Figure 14,2,2", ""]);
    expect(
      chartCsv(
        {
          figure: sweep,
          legend,
          table: [
            ["from [s]", "steps"],
            [0.001, 7],
          ],
        },
        [],
      ),
    ).toBe("from [s],steps\n0.001,7\n");
  });

  it("has a row for each cell of a map", () => {
    expect(chartCsv({ figure: map, legend: [], colours: "Peak, bump" }, []).split("\n")).toEqual([
      'Height [m],Peak [m/s²],"Peak, bump"',
      "1,10,5",
      "2,10,6",
      "1,20,7",
      "2,20,",
      "",
    ]);
  });
});
