/** The metric over the field for every strategy that is on, under a limit that can be dragged. */

import { Box, Group, Text, useComputedColorScheme } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import { useQueries } from "@tanstack/react-query";
import { useEffect, useEffectEvent, useState, type KeyboardEvent, type PointerEvent } from "react";
import { ask } from "../../api/http";
import type { Question, Scenario, Strategy, Solution } from "../../api/types";
import { valueText } from "../../scenario/limits";
import type { NumberField } from "../../scenario/schema";
import { fullName, type Metric } from "../../server/metrics";
import { MARGIN, marked, panelLayout } from "../../plots/figure";
import { PALETTES, type Palette } from "../../plots/palettes";
import type { PanelFigure, PlotTrace } from "../../plots/plotly";
import { StillSurface } from "../../plots/Surface";
import { StrategyName } from "../../ui/StrategyKey";
import { formatResult, prettyUnit } from "../../units/format";
import ui from "../../ui/ui.module.css";

/** No metric is larger: the whole range keeps it, and each of its values is driven. */
const NO_LIMIT = 1e12;
const HEIGHT = 190;
const OVER = { position: "absolute", inset: 0, fontSize: "var(--mantine-font-size-xs)", touchAction: "none" } as const;

export interface CurveQuestion extends Omit<Question, "strategy" | "field" | "limit"> {
  /** Each strategy's own, where its speed is asked for. */
  readonly fieldOf: (strategy: Strategy) => string;
}

interface Props {
  readonly scenario: Scenario;
  readonly question: CurveQuestion;
  readonly strategies: readonly Strategy[];
  readonly field: NumberField;
  readonly figure: Metric;
  /** In SI; `null` until there is one. */
  readonly limit: number | null;
  /** It has to get one as soon as there are curves. */
  readonly isOpening: boolean;
  readonly onLimit: (limit: number) => void;
}

interface Curve {
  readonly strategy: Strategy;
  readonly points: readonly Point[];
}

export function LimitChart({ scenario, question, strategies, field, figure, limit, isOpening, onLimit }: Props) {
  const { fieldOf, ...asked } = question;
  const answers = useQueries({
    queries: strategies.map((strategy) => {
      const body = { scenario, ...asked, strategy: strategy.id, field: fieldOf(strategy), limit: NO_LIMIT };
      return {
        queryKey: ["metric over a field", body],
        queryFn: ({ signal }: { readonly signal: AbortSignal }) => ask("post", "/solve", { body }, signal),
        staleTime: Infinity,
        retry: false,
      };
    }),
  });
  const curves = strategies.map((strategy, index): Curve => {
    const { data } = answers[index] ?? {};
    return { strategy, points: data ? curveOf(data.tried) : [] };
  });
  const waiting = answers.some(({ isPending }) => isPending);
  const isDrawn = !waiting && curves.some(({ points }) => points.length > 1);
  const opening = isDrawn ? openingLimit(curves.map(({ points }) => points)) : null;
  const open = useEffectEvent(onLimit);
  useEffect(() => {
    if (isOpening && opening !== null) open(opening);
  }, [isOpening, opening]);
  if (opening === null)
    return (
      <Text size="sm" c="dimmed" h={HEIGHT} aria-busy={waiting}>
        {waiting ? "Driving every strategy over the range…" : "No strategy could be driven over this range."}
      </Text>
    );
  const drawn = limit ?? opening;
  return (
    <div>
      <Drawing {...{ curves, field, figure, limit: drawn, onLimit }} />
      <Group
        component="ul"
        className={ui.list ?? ""}
        gap="0.2rem 1.2rem"
        fz="sm"
        aria-label="Where each strategy keeps the limit"
      >
        {curves.map(({ strategy, points }) => (
          <li key={strategy.id}>
            <StrategyName strategy={strategy} />: {rangesText(points, drawn, (value) => shortText(field, value))}
          </li>
        ))}
      </Group>
    </div>
  );
}

const shortText = (field: NumberField, value: number) => valueText(field, Number(value.toPrecision(3)));

interface DrawingProps extends Pick<Props, "field" | "figure" | "onLimit"> {
  readonly curves: readonly Curve[];
  readonly limit: number;
}

function Drawing({ curves, field, figure, limit, onLimit }: DrawingProps) {
  const { ref, width } = useElementSize<HTMLDivElement>();
  const palette = PALETTES[useComputedColorScheme("light")];
  // While it is dragged the line follows the pointer; the question is asked when it is let go.
  const [dragged, setDragged] = useState<number | null>(null);
  const { x: across, y: up } = extentOf(curves.map(({ points }) => points));
  const [wide, high] = [Math.max(1, width - MARGIN.l - MARGIN.r), HEIGHT - MARGIN.t - MARGIN.b];
  const toX = (value: number) => MARGIN.l + ((value - across[0]) / (across[1] - across[0] || 1)) * wide;
  const toY = (value: number) => MARGIN.t + high - ((value - up[0]) / (up[1] - up[0])) * high;
  const shown = dragged ?? limit;
  const inRange = (value: number) => Math.min(up[1], Math.max(up[0], value));
  const pointedAt = (event: PointerEvent<SVGElement>) => {
    const top = event.currentTarget.ownerSVGElement?.getBoundingClientRect().top ?? 0;
    return inRange(up[0] + ((MARGIN.t + high - (event.clientY - top)) / high) * (up[1] - up[0]));
  };
  const step = (up[1] - up[0]) / 50;
  const byKey = (event: KeyboardEvent) => {
    const by = { ArrowUp: step, ArrowRight: step, ArrowDown: -step, ArrowLeft: -step }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    onLimit(inRange(limit + by));
  };
  const { unit, scale } = figure;
  const name = `${fullName(figure)} over ${field.title}`;
  return (
    <Box ref={ref} pos="relative" h={HEIGHT}>
      <StillSurface figure={limitFigure(curves, { across, up }, { field, figure }, palette)} />
      <svg width={width} height={HEIGHT} style={OVER} role="group" aria-label={name}>
        {curves.map(({ strategy: { id, colour }, points }) => (
          <g key={id} stroke={colour}>
            {crossings(points, shown).map((x) => (
              <circle key={x} cx={toX(x)} cy={toY(shown)} r={4} fill="var(--surface)" strokeWidth={2} />
            ))}
          </g>
        ))}
        <g
          cursor="ns-resize"
          fill="var(--danger)"
          role="slider"
          tabIndex={0}
          aria-label="Limit"
          aria-orientation="vertical"
          aria-valuemin={up[0] * scale}
          aria-valuemax={up[1] * scale}
          aria-valuenow={shown * scale}
          aria-valuetext={`${formatResult(shown * scale)} ${prettyUnit(unit)}`}
          onKeyDown={byKey}
          onPointerDown={(event) => {
            event.currentTarget.setPointerCapture(event.pointerId);
            setDragged(pointedAt(event));
          }}
          onPointerMove={(event) => {
            if (dragged !== null) setDragged(pointedAt(event));
          }}
          onPointerUp={() => {
            if (dragged !== null) onLimit(dragged);
            setDragged(null);
          }}
        >
          <rect x={MARGIN.l} width={wide} y={toY(shown) - 12} height={24} fill="transparent" />
          <line
            stroke="var(--danger)"
            strokeWidth={1.5}
            strokeDasharray="6 4"
            x1={MARGIN.l}
            x2={MARGIN.l + wide}
            y1={toY(shown)}
            y2={toY(shown)}
          />
          <text x={MARGIN.l + 4} y={toY(shown) - 5}>
            limit {formatResult(shown * scale)} {prettyUnit(unit)}
          </text>
        </g>
      </svg>
    </Box>
  );
}

/** In the units that are shown. */
function limitFigure(
  curves: readonly Curve[],
  { across, up }: { readonly across: Range; readonly up: Range },
  { field: { shown }, figure }: Pick<Props, "field" | "figure">,
  palette: Palette,
): PanelFigure {
  const scaled = ([low, high]: Range, scale: number) => [low * scale, high * scale] as const;
  const data = curves.map(({ strategy: { label, colour, dash }, points }): PlotTrace => ({
    type: "scatter",
    mode: "lines",
    name: label,
    x: Float32Array.from(points, ([x]) => x * shown.scale),
    y: Float32Array.from(points, ([, y]) => y * figure.scale),
    line: { color: colour, width: 2, dash },
  }));
  const xaxis = marked(scaled(across, shown.scale), 7, ` ${prettyUnit(shown.unit)}`);
  return { data, layout: panelLayout(palette, xaxis, marked(scaled(up, figure.scale), 5), []) };
}

export type Point = readonly [x: number, y: number];
type Range = readonly [from: number, to: number];

/** What was driven, lowest value first; a value without the metric is left out. */
export const curveOf = (tried: Solution["tried"]): readonly Point[] =>
  tried
    .flatMap(({ value, metric_value }): readonly Point[] => (metric_value === null ? [] : [[value, metric_value]]))
    .sort(([a], [b]) => a - b);

/** Where the straight line between two points has that height. */
const at = ([x0, y0]: Point, [x1, y1]: Point, limit: number) => x0 + ((limit - y0) / (y1 - y0)) * (x1 - x0);

/** Where the curve, straight between its points, is at or below the limit. */
export function rangesBelow(curve: readonly Point[], limit: number): readonly Range[] {
  const ranges: Range[] = [];
  let start: number | null = null;
  for (const [index, point] of curve.entries()) {
    const [x, y] = point;
    const before = curve[index - 1];
    if (y <= limit && start === null) start = before ? at(before, point, limit) : x;
    if (y > limit && start !== null && before) {
      ranges.push([start, at(before, point, limit)]);
      start = null;
    }
  }
  const last = curve.at(-1);
  return start === null || !last ? ranges : [...ranges, [start, last[0]]];
}

/** Where the curve crosses the limit. */
export const crossings = (curve: readonly Point[], limit: number): readonly number[] =>
  rangesBelow(curve, limit)
    .flat()
    .filter((x) => x !== curve[0]?.[0] && x !== curve.at(-1)?.[0]);

/** `up to about 31 km/h`, or why there is no such value. */
export function rangesText(curve: readonly Point[], limit: number, textOf: (value: number) => string): string {
  const ranges = rangesBelow(curve, limit);
  const [[first] = [0], [last] = [0]] = [curve[0], curve.at(-1)];
  if (curve.length < 2) return "could not be driven";
  if (ranges.length === 0) return "above the limit over the whole range";
  return ranges
    .map(([from, to]) => {
      if (from === first && to === last) return "keeps the limit over the whole range";
      if (from === first) return `up to about ${textOf(to)}`;
      return to === last ? `from about ${textOf(from)} on` : `from about ${textOf(from)} to ${textOf(to)}`;
    })
    .join(", and ");
}

/** The ends of an axis on which all curves and the limit are seen. */
function extentOf(curves: readonly (readonly Point[])[]): { readonly x: Range; readonly y: Range } {
  const points = curves.flat();
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const low = Math.min(0, ...ys);
  const [first, last] = [Math.min(...xs), Math.max(...xs)];
  // Beside the corner, where the other axis has its own number.
  return { x: [first - 0.025 * (last - first), last], y: [low, low + 1.08 * (Math.max(...ys) - low) || 1] };
}

/** Half as high as the highest curve: where a limit that nobody has typed yet stands. */
const openingLimit = (curves: readonly (readonly Point[])[]): number => extentOf(curves).y[1] / 2;
