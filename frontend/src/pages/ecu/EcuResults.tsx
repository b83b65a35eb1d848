/** LV in the ECU beside LV in the simulation: the paper’s eight metrics with the rule for them, and Figures 19 to 22 for this scenario. */

import { Anchor, Text, Box, Group, SegmentedControl } from "@mantine/core";
import { Link } from "@tanstack/react-router";
import type { Catalogue, Strategy, Summary, FigureTemplate, FigureTemplates, Run } from "../../api/types";
import { useLabels, type Labels, useCatalogue, useCatalogues, useFigures } from "../../server/useCatalogues";
import { comparedMetrics, showValue, VIEWS } from "../../features/tables/entries";
import { metricName, valueAt, type WindowMetric } from "../../lab/metricPath";
import { ValueAndChange } from "../../features/tables/ChangeMark";
import { formatPercent, changeAgainst } from "../../features/tables/change";
import { Judged } from "./BuildReport";
import { StrategyName, NameWithUnit } from "../../ui/StrategyKey";
import { NO_VALUE, formatResult, prettyUnit } from "../../units/format";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card, Columns } from "../../ui/Card";
import { choicesOf } from "../../ui/Entry";
import ui from "../../ui/ui.module.css";
import { Note, Fault } from "../../ui/Messages";
import { useQuery } from "@tanstack/react-query";
import { useMemo, useState, type ComponentProps } from "react";
import type { Curves } from "../../plots/curves";
import { PlotPanels, useCurvesSource } from "../../plots/PlotGrid";
import { DEFAULT_VIEW, type Axis, type Zoom } from "../../lab/address";
import { fullName } from "../../server/metrics";
import { DETAIL_POINTS, seriesQuery } from "../../server/queries";
import { makeResultView } from "../../lab/resultView";
import { fromRun } from "../../lab/result";

interface Props {
  readonly summaries: Readonly<Record<string, Summary>>;
  readonly strategies: readonly Strategy[];
  readonly stale: boolean;
}

export function EcuTable({ summaries, strategies, stale }: Props) {
  const words = useLabels();
  const rows = rowsOf(words.catalogue, summaries);
  const judged = rows.filter(({ within }) => within !== null);
  const reached = judged.filter(({ within }) => within).length;
  const names = new Map(useCatalogues().figures.map((figure) => [figure.key, fullName(figure)]));
  return (
    <Card
      className={ui.follows}
      aria-label="LV in the ECU against LV in the simulation"
      data-stale={stale || undefined}
      title="ECU against simulation"
      tools={
        judged.length > 0 && (
          <Text fw={650} data-testid="hil-count" className={(reached === judged.length ? ui.good : ui.warning) ?? ""}>
            {reached} of {judged.length} within ±{RULE_PERCENT}&nbsp;%
          </Text>
        )
      }
    >
      <Text px="0.9rem" pb="sm" data-testid="hil-conclusion">
        {conclusionOf(rows, ({ key }) => names.get(key) ?? key)}
      </Text>
      <DataTable
        label="Metrics, in the ECU and in the simulation"
        groups={VIEWS.map((view) => ({
          key: view.window,
          title: words.view(view),
          rows: rows.filter(({ window }) => window === view.window),
        }))}
        rowKey={({ key }) => key}
        rowAttributes={({ key }) => ({ "data-cell": key })}
        columns={columnsOf(strategies, words)}
      />
      <Note className={ui.note ?? ""}>
        The rule of Tables 9 and 10: each change within ±{RULE_PERCENT}&nbsp;% of the simulation. Over many roads and
        beside what they print:{" "}
        <Anchor size="xs" underline="always" renderRoot={(props) => <Link to="/paper" {...props} />}>
          the paper page
        </Anchor>
        .
      </Note>
      <EcuEvents summary={summaries.lv_hil} catalogue={words.catalogue} />
    </Card>
  );
}

function columnsOf(strategies: readonly Strategy[], words: Labels): readonly Column<HilRow>[] {
  return [
    {
      key: "metric",
      head: "Metric",
      text: true,
      cell: ({ signal }) => <NameWithUnit name={words.signal(signal)} unit={words.unit(signal).unit} />,
    },
    ...strategies.map((strategy): Column<HilRow> => ({
      key: strategy.id,
      head: <StrategyName strategy={strategy} />,
      headAttributes: { style: { width: "19%" } },
      attributes: ({ values }) => ({ "data-value": values[strategy.id] ?? "" }),
      cell: ({ signal, values: { lv, [strategy.id]: value } }) => (
        <ValueAndChange
          text={typeof value === "number" ? formatResult(value * words.unit(signal).scale) : NO_VALUE}
          change={strategy.id === "lv" ? null : changeAgainst(value, lv)}
        />
      ),
    })),
    {
      key: "within",
      head: <>Within ±{RULE_PERCENT}&nbsp;%</>,
      attributes: ({ within }) => ({ "data-within": within ?? "" }),
      cell: ({ within, change }) =>
        within === null || change === null ? (
          NO_VALUE
        ) : (
          <Judged good={within}>{within ? "yes" : `no, ${formatPercent(change)}`}</Judged>
        ),
    },
  ];
}

/** What the loop itself met: held commands, unfinished iterations, clipped values. */
function EcuEvents({ summary, catalogue }: { readonly summary: Summary | undefined; readonly catalogue: Catalogue }) {
  const events = catalogue.events.filter(
    ({ key }) => key.startsWith("ecu_") && summary?.events[key] !== undefined && summary.events[key] !== null,
  );
  if (!summary || events.length === 0) return null;
  return (
    <dl className={`${ui.facts} ${ui.note}`} aria-label="What the loop met">
      {events.map(({ key, label, unit, description }) => (
        <div key={key} title={description}>
          <dt>{label}</dt>
          <dd>
            {showValue(summary.events[key])} {prettyUnit(unit)}
          </dd>
        </div>
      ))}
    </dl>
  );
}

/** What the ECU's code makes worse and better, and whether it still betters the LQR; empty while there is nothing to compare. */
export function conclusionOf(rows: readonly HilRow[], nameOf: (row: HilRow) => string): string {
  const compared = rows.filter(({ change }) => change !== null);
  if (compared.length === 0) return "";
  const change = ({ change: percent }: HilRow) => percent ?? 0;
  const sorted = compared.toSorted((a, b) => change(a) - change(b));
  const part = (verdict: "worse" | "better", most: HilRow | undefined) => {
    const number = compared.filter(
      ({ values: { lv, lv_hil: hil } }) => changeAgainst(hil, lv).verdict === verdict,
    ).length;
    return `${verdict} in ${number}${number > 0 && most ? ` (${formatPercent(change(most))} at most: ${nameOf(most)})` : ""}`;
  };
  const ahead = compared.filter(
    ({ values: { lv_hil: hil, lqr } }) => changeAgainst(hil, lqr).verdict === "better",
  ).length;
  return `Of ${compared.length} metrics the ECU’s code makes LV ${part("worse", sorted.at(-1))} and ${part("better", sorted[0])}; it is better than LQR in ${ahead}.`;
}

/** A change of at most so much [%] counts as reached: Tables 9 and 10 print +0.6 to +7.6. */
const RULE_PERCENT = 8;

interface HilRow extends WindowMetric {
  readonly key: string;
  /** By strategy. */
  readonly values: Readonly<Record<string, number | null | undefined>>;
  /** Of `lv_hil` against `lv` [%]. */
  readonly change: number | null;
  /** `null` where there is nothing to compare. */
  readonly within: boolean | null;
}

type Summaries = Readonly<Record<string, Summary>>;

export function rowsOf(catalogue: Pick<Catalogue, "paper_signals">, summaries: Summaries): readonly HilRow[] {
  return comparedMetrics(catalogue).map((metric): HilRow => {
    const values = Object.fromEntries(
      Object.entries(summaries).map(([id, summary]) => [id, valueAt(summary, metric)] as const),
    );
    const { percent } = changeAgainst(values.lv_hil, values.lv);
    const within = percent === null ? null : Math.abs(percent) <= RULE_PERCENT;
    return { ...metric, key: metricName(metric), values, change: percent, within };
  });
}

interface FiguresProps {
  readonly run: Run;
  readonly strategies: readonly Strategy[];
  readonly stale: boolean;
}

export function EcuFigures({ run, strategies, stale }: FiguresProps) {
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
    <section className={ui.follows} aria-label="Time histories" data-stale={stale || undefined}>
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
          data={choicesOf({ distance: "Distance", time: "Time" })}
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
