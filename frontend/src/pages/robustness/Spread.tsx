/** Every figure's spread under each strategy: bars to compare, a table to read, the worst case to open. */

import { SegmentedControl, Box, Group, useComputedColorScheme } from "@mantine/core";
import { useMemo, useRef, useState } from "react";
import type { BatchSummary, Strategy } from "../../api/types";
import { type Metric, fullName } from "../../server/metrics";
import { formatPercent } from "../../features/tables/change";
import { StrategyName, NameWithUnit } from "../../ui/StrategyKey";
import { formatResult } from "../../units/format";
import { RunButton } from "./RunButton";
import { quantile, type FigureSummary, type Margin, type StudyParts } from "./summary";
import type { Opening } from "../../features/sweep/useOpenRun";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card, Columns } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { Chart } from "../../plots/Chart";
import { ChartButton } from "../../plots/FigureButton";
import { ON_PAPER, PALETTES } from "../../plots/palettes";
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
        Thin bars: 5 to 95 %. Thick ones: 25 to 75 %. Line: median. Diamond: nominal, the scenario itself. Circle: worst
        case.
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

interface IntervalsProps extends Pick<StudyParts, "summary" | "strategies"> {
  readonly figure: Metric;
}

function Intervals({ summary, strategies, figure }: IntervalsProps) {
  const palette = PALETTES[useComputedColorScheme("light")];
  const host = useRef<HTMLDivElement>(null);
  const chart = useMemo(
    () => spreadChart(summary, strategies, figure, palette),
    [summary, strategies, figure, palette],
  );
  return (
    <Box component="figure" miw={0} m={0} data-figure={figure.key}>
      <Group component="figcaption" wrap="nowrap" gap="0.3em" fz="sm" fw={600}>
        {figure.label}
        <ChartButton
          title={fullName(figure)}
          file={`ridelab-${summary.batch}-spread-${figure.key}`}
          hostRef={host}
          draw={() => spreadChart(summary, strategies, figure, ON_PAPER)}
        />
      </Group>
      <Chart
        hostRef={host}
        figure={chart.figure}
        height={AROUND + ROW * strategies.length}
        label={`${fullName(figure)}: its spread under each strategy. Every value stands in the table below.`}
      />
    </Box>
  );
}

/** Of a strategy, and of the axis [px]. */
const [ROW, AROUND] = [28, 70];
