/** One panel's figure as large as the window, by plotly: values under the pointer, zoom, pan, and a file of what is in view. */

import { Modal, useComputedColorScheme } from "@mantine/core";
import { useViewportSize } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { useSelector } from "@tanstack/react-store";
import { useMemo } from "react";
import type { FigureTemplate } from "../api/types";
import { axisKey } from "../lab/resultView";
import { allSamplesQuery } from "../server/queries";
import { Chart, type ChartFigure } from "./Chart";
import { fileOf, type Curves, type CurvesSource } from "./curves";
import { axisSignal, axisUnit, buildFigure, overRoads } from "./figure";
import { chartLayout, PALETTES, type Palette } from "./palettes";
import { asText, withPlainNames } from "./plotly";

interface Props {
  readonly template: FigureTemplate;
  readonly curves: CurvesSource;
  readonly onClose: () => void;
}

/** The dialog's own head and margins [px]. */
const AROUND = 92;

export function EnlargedFigure({ template, curves: source, onClose }: Props) {
  const curves = useSelector(source);
  const palette = PALETTES[useComputedColorScheme("light")];
  const { height } = useViewportSize();
  const series = useAllSamples(template, curves);
  const figure = useMemo(() => enlarged(template, { ...curves, series }, palette), [template, curves, series, palette]);
  const { title, unit } = template.layout.meta;
  return (
    <Modal opened fullScreen onClose={onClose} title={title}>
      <Chart
        figure={figure}
        height={Math.max(240, height - AROUND)}
        label={`${title} in ${unit} over ${curves.axis}, enlarged`}
        tools={fileOf(template, curves)}
      />
    </Modal>
  );
}

/** Every sample of a stored run, as soon as it is there: one can zoom in as far as one likes. */
function useAllSamples(template: FigureTemplate, { series, strategies, runId, roads, minus }: Curves) {
  const ids = strategies.map(({ id }) => id);
  const query = allSamplesQuery(runId ?? "", ids, [template.layout.meta.signal], roads !== undefined);
  return useQuery({ ...query, enabled: runId !== null && minus === undefined }).data ?? series;
}

/** Opens on the panel's part of the run and has all of it: beyond the part one pans. */
export function enlarged(template: FigureTemplate, curves: Curves, palette: Palette): ChartFigure {
  const { meta } = template.layout;
  const { axis, series, minus, roads } = curves;
  const ends = Object.values(series).map((each) => each[axisKey(axis)]?.at(-1) ?? 0);
  const panel = buildFigure({ template, palette, ...curves }).layout;
  const { data, layout } = buildFigure({ template, palette, ...curves, range: [0, Math.max(...ends)] });
  const x = `${meta.axes[axisSignal(axis)] ?? ""}${roads === undefined ? "" : `. ${overRoads(roads, minus !== undefined)}`}`;
  const y = `${meta.title} [${meta.unit}]${minus === undefined ? "" : `, change against ${asText(minus)}`}`;
  return {
    data: withPlainNames(data).map((trace) => ({
      ...trace,
      name: trace.name ?? "",
      hovertemplate: `%{y:.4~g} ${meta.unit}`,
    })),
    layout: chartLayout(palette, {
      xaxis: {
        title: { text: x },
        range: panel.xaxis.range,
        unifiedhovertitle: { text: `%{x:.2f} ${axisUnit(axis)}` },
      },
      yaxis: { title: { text: y }, range: panel.yaxis.range, zeroline: true, zerolinecolor: palette.zero },
      shapes: layout.shapes,
      showlegend: true,
      legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom" },
      hovermode: "x unified",
      modebar: { bgcolor: "transparent", color: palette.zero, activecolor: palette.text },
      margin: { l: 64, r: 16, t: 72, b: 48 },
    }),
  };
}
