/** One figure: title, readouts, curves, and the pointer's layer over them. */

import { Box, Group } from "@mantine/core";
import { useIntersection } from "@mantine/hooks";
import { memo, useCallback, useEffect } from "react";
import { useLabContext } from "../lab/context";
import type { FigureTemplate, FigureMeta, SeriesByStrategy, Strategy } from "../api/types";
import type { Zoom, Axis } from "../lab/address";
import { printing } from "../lib/printing";
import { shallow, useSelector } from "@tanstack/react-store";
import { axisUnit, buildFigure } from "./figure";
import { fileOf, sameCurves, type Curves } from "./curves";
import type { Palette } from "./palettes";
import { EnlargeButton, FigureButton } from "./FigureButton";
import { Overlay } from "./Overlay";
import classes from "./plots.module.css";
import type { FigureSource } from "./saved";
import { Surface, type CurvesSource } from "./Surface";
import { Card } from "../ui/Card";
import { useCursor } from "../lab/cursor";
import { axisKey } from "../lab/resultView";
import { formatFixed } from "../units/format";
import { extent, valueAt } from "../lib/samples";

interface Props {
  readonly template: FigureTemplate;
  readonly curves: CurvesSource;
  readonly palette: Palette;
  readonly onZoom: (zoom: Zoom | null) => void;
}

const sourceOf = (template: FigureTemplate, curves: CurvesSource, file: string): FigureSource => ({
  title: template.layout.meta.title,
  file,
  paper: async (size) => (await import("./paperFigure")).paperFigure(template, curves.get(), size),
  csv: async () => (await import("./figureCsv")).figureCsv(template, curves.get(), window.location.href),
});

/** What a panel says beside its curves: most answers under a moving slider leave it as it is. */
const headOf = ({ strategies, axis, range, runId, minus }: Curves) => ({ strategies, axis, range, runId, minus });

/** Panels this close to the window are drawn too, so that scrolling meets no blank ones. */
const NEAR = "40px 0px";

export const PlotPanel = memo(function PlotPanel({ template, curves, palette, onZoom }: Props) {
  const { ref: viewRef, entry } = useIntersection<HTMLElement>({ rootMargin: NEAR });
  const printed = useSelector(printing);
  const inViewport = printed || (entry?.isIntersecting ?? false);
  const { meta } = template.layout;
  const { lab } = useLabContext();
  useEffect(() => (inViewport ? lab.draw(meta.signal) : undefined), [lab, inViewport, meta.signal]);
  const { strategies, axis, range, runId, minus } = useSelector(curves, headOf, { compare: sameCurves });
  const build = useCallback((drawn: Curves) => buildFigure({ template, palette, ...drawn }), [template, palette]);
  const drawn = strategies.map(({ label }) => label).join(", ");
  const part = `${axis} from ${formatFixed(range[0], 1)} to ${formatFixed(range[1], 1)} ${axisUnit(axis)}`;
  return (
    <Card ref={viewRef} className={classes.panel ?? ""} aria-label={`${meta.title}, curves`} data-figure={meta.signal}>
      <Group component="header" gap="0.5rem" wrap="nowrap" mih="2rem" p="0 0.7rem 0 0.8rem">
        <Box component="h2" flex="1 0 auto" maw="calc(100% - 7.2rem)" m={0} fz="sm" fw={600} lh="1.3">
          {meta.title}{" "}
          <Box component="span" fw={400} c="dimmed">
            {meta.unit}
            {minus !== undefined && `, change against ${minus}`}
          </Box>
        </Box>
        <Readouts {...{ meta, curves, strategies, axis }} />
        <Group gap={0} wrap="nowrap" flex="none" data-unprinted>
          <EnlargeButton template={template} curves={curves} />
          <FigureButton source={sourceOf(template, curves, fileOf(template, { runId }))} />
        </Group>
      </Group>
      <Box pos="relative" h={176} role="img" aria-label={`${meta.title} in ${meta.unit} over ${part}: ${drawn}`}>
        <Surface curves={curves} build={build} visible={inViewport} />
        <Overlay axis={axis} range={range} onZoom={onZoom} />
      </Box>
    </Card>
  );
});

interface ReadoutsProps {
  readonly meta: FigureMeta;
  readonly curves: CurvesSource;
  readonly strategies: readonly Strategy[];
  readonly axis: Axis;
}

/** As many decimals as give three digits to the run's largest value: the numbers keep their width while they change. */
function decimalsFor({ signal, scale }: FigureMeta, all: SeriesByStrategy): number {
  const ends = Object.values(all).flatMap((series) => (series[signal] ? (extent(series[signal]) ?? []) : []));
  const largest = Math.max(0, ...ends.map((value) => Math.abs(value * scale)));
  return largest > 0 ? Math.min(6, Math.max(0, 2 - Math.floor(Math.log10(largest)))) : 0;
}

/** The curves' values at the cursor, beside the panel's title. */
function Readouts({ meta, curves, strategies, axis }: ReadoutsProps) {
  const x = useCursor(axis);
  const texts = useSelector(curves, ({ series }) => readings(meta, series, strategies, axis, x), { compare: shallow });
  return (
    <span className={classes.readouts} data-empty={x === null || undefined} aria-hidden>
      {strategies.map(({ id, colour }, index) => (
        <span key={id} className={classes.readout}>
          <span className={classes.swatch} style={{ background: colour }} />
          {texts[index] ?? "–"}
        </span>
      ))}
    </span>
  );
}

function readings(
  meta: FigureMeta,
  series: SeriesByStrategy,
  strategies: readonly Strategy[],
  axis: Axis,
  x: number | null,
): readonly (string | null)[] {
  if (x === null) return [];
  const decimals = decimalsFor(meta, series);
  return strategies.map(({ id }) => {
    const [samples, values] = [series[id]?.[axisKey(axis)], series[id]?.[meta.signal]];
    const value = samples && values ? valueAt(samples, values, x) : null;
    return value === null ? null : formatFixed(value * meta.scale, decimals);
  });
}
