/** Every figure's spread under each strategy: bars to compare, a table to read, the worst case to open. */

import { SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { BatchSummary, Strategy } from "../../api/types";
import type { Metric } from "../../server/metrics";
import { formatPercent } from "../../features/tables/change";
import { StrategyName } from "../../ui/StrategyKey";
import { formatResult, prettyUnit } from "../../units/format";
import { Intervals } from "./Intervals";
import { RunButton } from "./RunButton";
import { quantile, type FigureSummary, type Margin, type StudyParts } from "./summary";
import type { Opening } from "../../features/sweep/useOpenRun";
import styles from "./bars.module.css";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";

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
      <div className={styles.panels}>
        {shown.map((figure) => (
          <Intervals key={figure.key} {...{ summary, strategies, figure }} />
        ))}
      </div>
      <DataTable
        label="Values of the spread"
        columns={columnsOf({ summary, shownGroup, against, opening })}
        groups={shown.map((figure) => ({
          key: figure.key,
          title: (
            <>
              {figure.label} <span className={ui.dim}>{prettyUnit(figure.unit)}</span>
            </>
          ),
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
    <Text component="div" size="xs" c="dimmed" className={styles.key ?? ""}>
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
    </Text>
  );
}
