/** Figures 19 to 22 for this scenario: the paper's four signals, in the ECU, in the simulation and under the LQR. */

import { Box, Group, SegmentedControl } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useMemo, useState, type ComponentProps } from "react";
import type { Catalogue, FigureTemplate, FigureTemplates, Run, Strategy } from "../../api/types";
import type { Curves } from "../../plots/curves";
import { PlotPanels, useCurvesSource } from "../../plots/PlotGrid";
import { DEFAULT_VIEW, type Axis, type Zoom } from "../../lab/address";
import { useCatalogue, useFigures } from "../../server/useCatalogues";
import { DETAIL_POINTS, seriesQuery } from "../../server/queries";
import { makeResultView } from "../../lab/resultView";
import { fromRun } from "../../lab/result";
import { StrategyName } from "../../ui/StrategyKey";
import classes from "./ecu.module.css";
import { Fault } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";
import { Columns } from "../../ui/Card";

interface Props {
  readonly run: Run;
  readonly strategies: readonly Strategy[];
  readonly stale: boolean;
}

export function EcuFigures({ run, strategies, stale }: Props) {
  const [catalogue, figures] = [useCatalogue(), useFigures()];
  const [axis, setAxis] = useState<Axis>("time");
  const [zoom, setZoom] = useState<Zoom | null>(null);
  const ids = useMemo(
    () => Object.entries(run.strategies).flatMap(([id, { status }]) => (status === "ok" ? [id] : [])),
    [run],
  );
  const drawn = strategies.filter(({ id }) => ids.includes(id));
  const series = useQuery(seriesQuery(run.id, ids, DETAIL_POINTS));
  const resultView = useMemo(() => {
    if (!series.data) return null;
    const shown = fromRun(run, { series: series.data, missing: null }, 0, true);
    return makeResultView(shown, strategies, ids, { ...DEFAULT_VIEW, baseline: "lv", axis, zoom: zoom ?? "whole" });
  }, [run, series.data, strategies, ids, axis, zoom]);
  const curves = useMemo(
    () =>
      resultView && {
        ...resultView,
        sourceSeries: resultView.series,
        live: false,
        runId: resultView.shown.runId,
        coreVersion: resultView.shown.coreVersion,
      },
    [resultView],
  );
  const templates = useMemo(() => templatesOf(catalogue, figures), [catalogue, figures]);
  return (
    <section className={classes.part} aria-label="Time histories" data-stale={stale || undefined}>
      <Group component="header" gap="0.4rem 1rem" mih="2.7rem" p="0.4rem 0.9rem">
        <h2 className={ui.heading}>Figures 19 to 22, for this scenario</h2>
        <Group component="span" gap="0.2rem 0.9rem" fz="xs" c="dimmed">
          {drawn.map((strategy) => (
            <StrategyName key={strategy.id} strategy={strategy} />
          ))}
        </Group>
        <SegmentedControl
          aria-label="Plots over"
          value={axis}
          data={[
            { value: "distance", label: "Distance" },
            { value: "time", label: "Time" },
          ]}
          onChange={(next) => {
            setAxis(next);
            setZoom(null);
          }}
        />
      </Group>
      {series.isError && <Fault size="md">The time histories could not be read: {series.error.message}</Fault>}
      <Columns>
        {curves ? (
          <Panels {...{ templates, curves }} onZoom={setZoom} />
        ) : (
          templates.map(({ layout }) => <Box key={layout.meta.signal} h={210} className={ui.card ?? ""} />)
        )}
      </Columns>
    </section>
  );
}

interface PanelsProps extends Omit<ComponentProps<typeof PlotPanels>, "curves"> {
  readonly curves: Curves;
}

function Panels({ curves, ...props }: PanelsProps) {
  return <PlotPanels {...props} curves={useCurvesSource(curves)} />;
}

/** Drawn from the back to the front: what swings furthest would hide what is compared. */
const ORDER: readonly string[] = ["lqr", "lv", "lv_hil"];

function templatesOf(catalogue: Catalogue, figures: FigureTemplates): readonly FigureTemplate[] {
  return catalogue.paper_signals.flatMap((signal) => {
    const template = Object.values(figures).find(({ layout }) => layout.meta.signal === signal);
    return template
      ? [
          {
            ...template,
            data: template.data.toSorted((a, b) => ORDER.indexOf(a.meta.strategy) - ORDER.indexOf(b.meta.strategy)),
          },
        ]
      : [];
  });
}
