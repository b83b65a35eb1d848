/** Every figure's spread under each strategy: bars to compare, a table to read, the worst case to open. */

import { SegmentedControl, Box, Group } from "@mantine/core";
import { useState } from "react";
import type { BatchSummary, Strategy } from "../../api/types";
import { type Metric, fullName } from "../../server/metrics";
import { formatPercent } from "../../features/tables/change";
import { StrategyName, NameWithUnit } from "../../ui/StrategyKey";
import { formatResult, prettyUnit, formatNumber } from "../../units/format";
import { RunButton } from "./RunButton";
import { quantile, type FigureSummary, type Margin, type StudyParts } from "./summary";
import type { Opening } from "../../features/sweep/useOpenRun";
import styles from "./bars.module.css";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card, Columns } from "../../ui/Card";
import columns from "../../ui/columns.module.css";
import ui from "../../ui/ui.module.css";
import { stepAbove } from "../../lib/steps";
import { ChartButton } from "../../plots/FigureButton";
import { spreadChart } from "./paperSpread";

type Props = Pick<StudyParts, "summary" | "strategies" | "figures" | "opening">;

export function Spread({ summary, strategies, figures, opening }: Props) {
  const groups = [...new Set(figures.map(({ group }) => group))];
  const [shownGroup, setShownGroup] = useState(groups[0] ?? "");
  const shown = figures.filter(({ group }) => group === shownGroup);
  const against = strategies.find(({ id }) => id === summary.baseline)?.label ?? summary.baseline;
  return (
    <Card
      aria-label="Spread"
      title="Spread of the metrics"
      tools={<SegmentedControl aria-label="Figures" value={shownGroup} data={groups} onChange={setShownGroup} />}
    >
      <Key />
      <Columns className={columns.whole ?? ""} gap="0.4rem 2rem" p="0.3rem 1rem 0.8rem">
        {shown.map((figure) => (
          <Intervals key={figure.key} {...{ summary, strategies, figure }} />
        ))}
      </Columns>
      <DataTable
        label="Values of the spread"
        columns={columnsOf({ summary, shownGroup, against, opening })}
        groups={shown.map((figure) => ({
          key: figure.key,
          title: <NameWithUnit name={figure.label} unit={figure.unit} />,
          rows: strategies.flatMap((strategy) => {
            const results = summary.strategies[strategy.id]?.figures[figure.key];
            return results ? [{ strategy, figure, results }] : [];
          }),
        }))}
        rowKey={({ strategy }) => strategy.id}
        rowAttributes={({ strategy, figure }) => ({ "data-strategy": strategy.id, "data-figure": figure.key })}
      />
    </Card>
  );
}

interface Row {
  readonly strategy: Strategy;
  readonly figure: Metric;
  readonly results: FigureSummary;
}

interface Context {
  readonly summary: BatchSummary;
  readonly shownGroup: string;
  readonly against: string;
  readonly opening: Opening;
}

const PERCENTS = { Median: 50, "5 %": 5, "95 %": 95 };

function columnsOf({ summary, shownGroup, against, opening }: Context): readonly Column<Row>[] {
  const group = shownGroup;
  const value = (number: number | null, { figure }: Row) =>
    number === null ? "–" : formatResult(number * figure.scale);
  const change = (percent: number, margin: Margin | null) => {
    const at = margin && quantile(summary, margin, percent);
    return typeof at === "number" ? formatPercent(at) : margin ? "–" : "";
  };
  return [
    { key: "strategy", head: "Strategy", text: true, cell: ({ strategy }) => <StrategyName strategy={strategy} /> },
    { key: "nominal", group, head: "Nominal", cell: (row) => value(row.results.nominal, row) },
    ...Object.entries(PERCENTS).map(([head, percent]): Column<Row> => ({
      key: head,
      group,
      head,
      attributes: () => ({ style: { fontWeight: percent === 50 ? 600 : undefined } }),
      cell: (row) => value(quantile(summary, row.results, percent), row),
    })),
    {
      key: "worst",
      group,
      head: "Worst case",
      cell: (row) => (
        <RunButton
          run={row.results.highest}
          text={value(row.results.highest?.value ?? null, row)}
          what={`${row.strategy.label}, ${row.figure.label}: worst case`}
          opening={opening}
        />
      ),
    },
    ...Object.entries(PERCENTS).map(([head, percent]): Column<Row> => ({
      key: `change ${head}`,
      group: `Change against ${against} at the same point`,
      head,
      cell: ({ results }) => change(percent, results.margin),
    })),
  ];
}

function Key() {
  return (
    <Group fz="xs" c="dimmed" gap="0.2rem 1.2rem" p="0 1rem 0.4rem" className={styles.key ?? ""}>
      <span>
        <i className={styles.bar} /> 5 to 95 %
      </span>
      <span>
        <i className={styles.box} /> 25 to 75 %
      </span>
      <span>
        <i className={styles.median} /> median
      </span>
      <span>
        <i className={styles.nominal} /> nominal: the scenario itself
      </span>
      <span>
        <i className={styles.worst} /> worst case
      </span>
    </Group>
  );
}

interface IntervalsProps extends Pick<StudyParts, "summary" | "strategies"> {
  readonly figure: Metric;
}

function Intervals({ summary, strategies, figure }: IntervalsProps) {
  const rows = strategies.flatMap((strategy) => {
    const figureSummary = summary.strategies[strategy.id]?.figures[figure.key];
    return figureSummary ? [{ strategy, figureSummary }] : [];
  });
  const most = Math.max(
    0,
    ...rows.flatMap(({ figureSummary }) => [figureSummary.highest?.value ?? 0, figureSummary.nominal ?? 0]),
  );
  const { end, ticks } = scaleTo(most * figure.scale);
  return (
    <Box component="figure" miw={0} m={0} data-figure={figure.key}>
      <Group component="figcaption" wrap="nowrap" gap="0.3em" mb="0.2rem" fz="sm" fw={600}>
        {figure.label} <span className={ui.dim}>{prettyUnit(figure.unit)}</span>
        <ChartButton
          title={fullName(figure)}
          file={`ridelab-${summary.batch}-spread-${figure.key}`}
          draw={() => spreadChart(summary, strategies, figure)}
        />
      </Group>
      {rows.map(({ strategy, figureSummary }) => (
        <div key={strategy.id} className={styles.interval}>
          <span className={styles.intervalName}>{strategy.label}</span>
          <Track {...{ summary, strategy, figureSummary, figure, end }} />
        </div>
      ))}
      <div className={styles.interval} aria-hidden>
        <span className={styles.intervalName} />
        <span className={styles.axis}>
          {ticks.map((tick) => (
            <span key={tick} style={{ left: `${(100 * tick) / end}%` }}>
              {formatTick(tick)}
            </span>
          ))}
        </span>
      </div>
    </Box>
  );
}

const formatTick = (tick: number) =>
  tick === 0
    ? "0"
    : formatNumber(tick, 2)
        .replace(/(\.\d*?)0+$/, "$1")
        .replace(/\.$/, "");

interface TrackProps {
  readonly summary: BatchSummary;
  readonly strategy: Strategy;
  readonly figureSummary: FigureSummary;
  readonly figure: Metric;
  readonly end: number;
}

function Track({ summary, strategy, figureSummary, figure: { label, unit, scale }, end }: TrackProps) {
  const offset = (value: number) => `${Math.max(0, Math.min(100, (100 * value * scale) / end))}%`;
  const at = (percent: number) => quantile(summary, figureSummary, percent);
  const span = (low: number | null, high: number | null) =>
    low === null || high === null
      ? { display: "none" }
      : { left: offset(low), width: `calc(${offset(high)} - ${offset(low)})`, background: strategy.colour };
  const [p5, p25, p50, p75, p95] = [at(5), at(25), at(50), at(75), at(95)];
  const text = (value: number | null) => (value === null ? "none" : formatResult(value * scale));
  const words = `${strategy.label}, ${label}: median ${text(p50)}, 5 % ${text(p5)}, 95 % ${text(p95)}, worst ${text(figureSummary.highest?.value ?? null)}, nominal ${text(figureSummary.nominal)} ${prettyUnit(unit)}`;
  return (
    <span className={styles.track} role="img" aria-label={words} title={words}>
      <span className={styles.bar} style={span(p5, p95)} />
      <span className={styles.box} style={span(p25, p75)} />
      {p50 !== null && <span className={styles.median} style={{ left: offset(p50) }} />}
      {figureSummary.highest && (
        <span
          className={styles.worst}
          style={{ left: offset(figureSummary.highest.value), borderColor: strategy.colour }}
        />
      )}
      {figureSummary.nominal !== null && (
        <span className={styles.nominal} style={{ left: offset(figureSummary.nominal) }} />
      )}
    </span>
  );
}

/** A scale from zero that ends on a round number. */
export function scaleTo(most: number): { readonly end: number; readonly ticks: readonly number[] } {
  if (!(most > 0)) return { end: 1, ticks: [0] };
  const step = stepAbove(most / 4);
  const count = Math.ceil(most / step - 1e-9);
  // Multiples of the step, without the dust of binary fractions.
  const at = (index: number) => Number((index * step).toPrecision(10));
  return { end: at(count), ticks: Array.from({ length: count + 1 }, (_, index) => at(index)) };
}
