/** What a figure's file is made of, whichever plot it is of. */

import { type AnyTrace, type PlotLayout } from "./plotly";
import { type FigureTemplate } from "../api/types";
import { axisSignal, axisUnit, buildFigure, overRoads } from "./figure";
import { ownLaws, type Curves } from "./curves";
import { ON_PAPER } from "./palettes";

export interface PaperSize {
  /** [mm] */
  readonly width: number;
  /** [pt] */
  readonly font: number;
}

export interface PaperFigure<Trace extends AnyTrace = AnyTrace> {
  /** [mm] */
  readonly width: number;
  readonly height: number;
  readonly data: readonly Trace[];
  readonly layout: PlotLayout;
}

export interface FigureSource {
  readonly title: string;
  /** Name of the file without its ending. */
  readonly file: string;
  readonly paper: (size: PaperSize) => Promise<PaperFigure>;
  readonly csv: () => Promise<string>;
}

/** On one line, and nothing of it a formula to a spreadsheet, whichever sign separates its cells. */
const harmless = (text: string) =>
  text.replace(/[\p{Cc}\u2028\u2029]+/gu, " ").replace(/(^|[,;])(\s*)(?=[=+\-@])/g, "$1$2'");

export function cell(text: string): string {
  const clean = harmless(text);
  return /[",;]/.test(clean) ? `"${clean.replaceAll('"', '""')}"` : clean;
}

/** A line that says where the numbers come from. */
export const comment = (text: string): string => harmless(`# ${text}`);

/**
 * Lines of `#` say where it comes from; below stand, for each curve, its places and its values.
 *
 * Curves have samples of their own: shorter ones end in empty cells.
 */
export function figureCsv(template: FigureTemplate, curves: Curves, address: string): string {
  const { title, unit } = template.layout.meta;
  const { data } = buildFigure({ template, ...curves, palette: ON_PAPER });
  const provenance = [
    `Ridelab: ${title} [${unit}]${curves.minus === undefined ? "" : `, change against ${curves.minus}`}`,
    `run: ${curves.runId ?? "none, a live preview"}`,
    `core: ${curves.coreVersion}`,
    ...ownLaws(curves).map((law) => `law of ${law}`),
    ...(curves.roads === undefined ? [] : [overRoads(curves.roads, curves.minus !== undefined)]),
    `scenario: ${address}`,
  ];
  const names = data.flatMap(({ name = title }) => [
    `${name}: ${axisSignal(curves.axis)} [${axisUnit(curves.axis)}]`,
    `${name}: ${title} [${unit}]`,
  ]);
  const columns = data.flatMap(({ x, y }) => [x, y]);
  const longest = Math.max(0, ...columns.map(({ length }) => length));
  const rows = Array.from({ length: longest }, (_, row) => columns.map((column) => printed(column[row])).join(","));
  return [...provenance.map(comment), names.map(cell).join(","), ...rows, ""].join("\n");
}

/** As many digits as single precision has. */
export const printed = (value: number | undefined) => (value === undefined ? "" : String(Number(value.toPrecision(7))));
