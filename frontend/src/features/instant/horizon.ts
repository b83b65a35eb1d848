/** Figures of what was planned over the horizon, and of the road ahead. Pure. */

import type { InstantAnswer } from "../../api/types";
import { extent } from "../../lib/samples";
import { marked, panelLayout, verticalRange } from "../../plots/figure";
import type { Palette } from "../../plots/palettes";
import type { PanelFigure, PlotTrace } from "../../plots/plotly";

export interface HorizonFigure {
  readonly title: string;
  readonly unit: string;
  readonly figure: PanelFigure;
}

/** The rear axle's dash; the front one's line is solid. */
export const REAR_DASH = "5,3";
const [X_TICKS, Y_TICKS, ROOM] = [4, 4, 0.04];
const [MILLI, LEAST_FORCE, LEAST_TRAVEL] = [1000, 20, 2];

type Pair = readonly (readonly number[])[];

interface Drawn {
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly colour: string;
  readonly dash?: string;
  readonly width?: number;
}

const column = (rows: Pair, index: number, scale = 1) => rows.map((row) => (row[index] ?? 0) * scale);

function figureOf(drawn: readonly Drawn[], limit: number | null, least: number, palette: Palette): PanelFigure {
  const data = drawn.map(({ x, y, colour, dash = "", width = 1.8 }): PlotTrace => ({
    type: "scatter",
    mode: "lines",
    x: Float32Array.from(x),
    y: Float32Array.from(y),
    line: { color: colour, width, dash },
  }));
  const references = limit === null ? [] : [-limit, limit];
  const [from, to] = extent(Float32Array.from(drawn.flatMap(({ x }) => x))) ?? [0, 1];
  const range = [from, to + ROOM * (to - from)] as const; // the last mark's unit needs it
  const line = { color: palette.text, width: 1, dash: "dot" };
  const shapes = references.map((y) => ({ type: "line", xref: "paper", yref: "y", x0: 0, x1: 1, y0: y, y1: y, line }));
  const vertical = verticalRange(data, references, 0, least);
  return { data, layout: panelLayout(palette, marked(range, X_TICKS, " s"), marked(vertical, Y_TICKS), shapes) };
}

/** A held value's line: each stands from one instant to the next. */
function held(time: readonly number[], values: readonly number[]): Pick<Drawn, "x" | "y"> {
  return {
    x: values.flatMap((_, index) => [time[index] ?? 0, time[index + 1] ?? 0]),
    y: values.flatMap((value) => [value, value]),
  };
}

/** What there is of an instant to draw, over the seconds from now on. */
export function horizonFigures(instant: InstantAnswer, colour: string, palette: Palette): readonly HorizonFigure[] {
  const { predicted_time: times, predicted_states: states, predicted_forces: forces, preview, limits } = instant;
  const limitOf = (name: string) => limits.find((limit) => limit.name === name)?.limit ?? null;
  const figures: HorizonFigure[] = [];
  const axle = (index: number) => ({ colour, ...(index === 1 && { dash: REAR_DASH }) });
  if (times && states && forces) {
    const time = times.map((each) => each - instant.time);
    const travel = limitOf("front_deflection");
    figures.push({
      title: "Planned suspension travel",
      unit: "mm",
      figure: figureOf(
        [0, 1].map((index) => ({ x: time, y: column(states, index, MILLI), ...axle(index) })),
        travel === null ? null : travel * MILLI,
        LEAST_TRAVEL,
        palette,
      ),
    });
    figures.push({
      title: "Planned forces",
      unit: "N",
      figure: figureOf(
        [0, 1].map((index) => ({ ...held(time, column(forces, index)), ...axle(index) })),
        limitOf("front_force"),
        LEAST_FORCE,
        palette,
      ),
    });
  }
  if (preview) {
    const x = preview.time.map((each) => each - instant.time);
    const road = (rows: Pair, index: number) => ({ x, y: column(rows, index, MILLI), ...axle(index) });
    figures.push({
      title: "Road ahead: as seen, over the real one in grey",
      unit: "mm",
      figure: figureOf(
        [
          ...[0, 1].map((index) => ({ ...road(preview.real, index), colour: palette.zero, width: 4 })),
          ...[0, 1].map((index) => road(preview.seen, index)),
        ],
        null,
        LEAST_TRAVEL,
        palette,
      ),
    });
  }
  return figures;
}
