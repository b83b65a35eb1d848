/** Every figure’s spread under each strategy: bars to compare, a table to read, the worst case to open; and what must not happen at all. */

import { SegmentedControl, Box, Group, Text } from "@mantine/core";
import { useCallback, useState } from "react";
import type { BatchSummary, Strategy } from "../../api/types";
import { type Metric, fullName } from "../../server/metrics";
import { formatPercent } from "../../features/tables/change";
import { SureChange } from "../../features/tables/ChangeMark";
import { StrategyName, NameWithUnit } from "../../ui/StrategyKey";
import { formatResult, formatFixed, formatWhole } from "../../units/format";
import { RunButton } from "./RunButton";
import {
  quantile,
  type FigureSummary,
  type Margin,
  type StudyParts,
  AIRBORNE,
  TRAVEL,
  type StrategySummary,
} from "./study";
import type { Opening } from "../../features/sweep/table";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card, Columns } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { Chart } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { Note } from "../../ui/Messages";
import { spreadChart } from "./charts";

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
      <Note className={ui.note ?? ""}>
        Arrows: the change is better or worse at 5 and 95 % alike. Thin bars: 5 to 95 %. Thick ones: 25 to 75 %. Line:
        median. Diamond: nominal, the scenario itself. Circle: worst case.
      </Note>
      <Columns className={ui.whole ?? ""} least="18rem" gap="0.4rem 1rem" p="0.3rem 1rem 0.8rem">
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

interface Context extends Pick<Props, "summary" | "opening"> {
  readonly shownGroup: string;
  readonly against: string;
}

const PERCENTS = { Median: 50, "5 %": 5, "95 %": 95 };

function columnsOf({ summary, shownGroup, against, opening }: Context): readonly Column<Row>[] {
  const group = shownGroup;
  const value = (number: number | null, { figure }: Row) =>
    number === null ? "–" : formatResult(number * figure.scale);
  const change = (percent: number, margin: Margin | null) => {
    if (margin === null) return "";
    const at = quantile(summary, margin, percent);
    if (at === null) return "–";
    return percent === 50 ? (
      <SureChange value={at} low={quantile(summary, margin, 5)} high={quantile(summary, margin, 95)} />
    ) : (
      formatPercent(at)
    );
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

interface IntervalsProps extends Pick<StudyParts, "summary" | "strategies"> {
  readonly figure: Metric;
}

function Intervals({ summary, strategies, figure }: IntervalsProps) {
  const { chart, button } = useChart({
    title: fullName(figure),
    file: `ridelab-${summary.batch}-spread-${figure.key}`,
    draw: useCallback(
      ({ palette }: Look) => spreadChart(summary, strategies, figure, palette),
      [summary, strategies, figure],
    ),
  });
  return (
    <Box component="figure" miw={0} m={0} data-figure={figure.key}>
      <Group component="figcaption" wrap="nowrap" gap="0.3em" fz="sm" fw={600}>
        {figure.label}
        {button}
      </Group>
      <Chart
        {...chart}
        height={AROUND + ROW * strategies.length}
        label={`${fullName(figure)}: its spread under each strategy. Every value stands in the table below.`}
      />
    </Box>
  );
}

/** Of a strategy, and of the axis [px]. */
const [ROW, AROUND] = [28, 70];

/** What must not happen: an unstable loop, too much travel, a wheel off the road, a run without a result. */
export function Limits({ summary, strategies, opening }: Omit<Props, "figures">) {
  const reasons = strategies.flatMap(({ id, label }) =>
    Object.entries(summary.strategies[id]?.reasons ?? {}).map(([reason, times]) => ({ label, reason, times })),
  );
  const rows = strategies.flatMap((strategy): LimitRow[] => {
    const results = summary.strategies[strategy.id];
    return results ? [{ strategy, results }] : [];
  });
  return (
    <Card aria-label="Limits and stability" title="Limits and stability">
      <DataTable
        label="Limits"
        rows={rows}
        rowKey={({ strategy }) => strategy.id}
        rowAttributes={({ strategy }) => ({ "data-strategy": strategy.id })}
        columns={limitColumns(summary, opening)}
      />
      {reasons.map(({ label, reason, times: count }) => (
        <Text key={`${label} ${reason}`} size="xs" className={`${ui.error ?? ""} ${ui.note ?? ""}`}>
          {label}, {formatWhole(count)} failed: {reason}
        </Text>
      ))}
      <Note className={ui.note ?? ""}>
        Of the loop’s modes near rest, where no limit binds: 1 does not oscillate, 0 oscillates for ever, below 0 is
        unstable. Preview is not fed back, so no error of it can make a loop unstable.
      </Note>
    </Card>
  );
}

const times = (count: number, of: number) => (count === 0 ? "no point" : `${formatWhole(count)} of ${formatWhole(of)}`);

interface LimitRow {
  readonly strategy: Strategy;
  readonly results: StrategySummary;
}

const bad = (count: number) => ({ "data-bad": count > 0 || undefined });

function limitColumns(summary: BatchSummary, opening: Opening): readonly Column<LimitRow>[] {
  const damping = { group: "Least damping ratio of the closed loop" };
  return [
    { key: "strategy", head: "Strategy", text: true, cell: ({ strategy }) => <StrategyName strategy={strategy} /> },
    {
      ...damping,
      key: "nominal",
      head: "nominal",
      span: ({ results }) => (results.stability.known === 0 ? 4 : 1),
      cell: ({ results: { stability } }) =>
        stability.known === 0 ? (
          <span className={ui.dim}>not judged: this controller is no linear law</span>
        ) : (
          shown(stability.nominal)
        ),
    },
    {
      ...damping,
      key: "median",
      head: "median",
      cell: ({ results }) => shown(quantile(summary, results.stability, 50)),
    },
    {
      ...damping,
      key: "lowest",
      head: "lowest",
      cell: ({ strategy, results: { stability } }) => (
        <RunButton
          run={stability.lowest}
          text={shown(stability.lowest?.value ?? null)}
          what={`${strategy.label}: least damping`}
          opening={opening}
        />
      ),
    },
    {
      ...damping,
      key: "unstable",
      head: "unstable at",
      attributes: ({ results }) => bad(results.stability.unstable),
      cell: ({ results: { stability } }) => times(stability.unstable, stability.known),
    },
    ...eventColumns(TRAVEL, "Travel over the limit", "mm", opening),
    ...eventColumns(AIRBORNE, "A tyre airborne", "ms", opening),
    {
      key: "failed",
      group: "Runs",
      head: "failed",
      attributes: ({ results }) => bad(results.failed),
      cell: ({ results }) => formatWhole(results.failed),
    },
  ];
}

const shown = (damping: number | null) => (damping === null ? "–" : formatFixed(damping, 2));

function eventColumns(event: string, group: string, unit: string, opening: Opening): readonly Column<LimitRow>[] {
  return [
    {
      key: `${event} at`,
      group,
      head: "at",
      attributes: ({ results }) => bad(results.figures[event]?.above_zero ?? 0),
      cell: ({ results: { figures } }) => (figures[event] ? times(figures[event].above_zero, figures[event].n) : "–"),
    },
    {
      key: `${event} most`,
      group,
      head: "at most",
      cell({ strategy, results: { figures } }) {
        const { above_zero: happens = 0, highest = null } = figures[event] ?? {};
        if (happens === 0 || !highest) return "–";
        return (
          <RunButton
            run={highest}
            text={`${formatResult(highest.value)}\u00a0${unit}`}
            what={`${strategy.label}: ${group.toLowerCase()}`}
            opening={opening}
          />
        );
      },
    },
  ];
}
