/** Every figure's spread under each strategy: bars to compare, a table to read, the worst case to open. */

import { SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { BatchSummary, Strategy } from "../api/types";
import type { Figure } from "../batch/figures";
import { formatPercent } from "../tables/change";
import { StrategyKey } from "../tables/StrategyKey";
import { formatResult, prettyUnit } from "../units/format";
import { Intervals } from "./Intervals";
import { RunButton } from "./RunButton";
import classes from "./robustness.module.css";
import { quantile, type FigureSummary } from "./summary";
import type { Opening } from "../batch/useOpenRun";
import styles from "./bars.module.css";
import { ScrollTable } from "../ui/ScrollTable";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

interface Props {
  readonly summary: BatchSummary;
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Figure[];
  readonly opening: Opening;
}

export function Spread({ summary, strategies, figures, opening }: Props) {
  const groups = [...new Set(figures.map(({ group }) => group))];
  const [shownGroup, setShownGroup] = useState(groups[0] ?? "");
  const shown = figures.filter(({ group }) => group === shownGroup);
  const against = strategies.find(({ id }) => id === summary.baseline)?.label ?? summary.baseline;
  return (
    <Card
      aria-label="Spread"
      title="Spread of the metrics"
      tools={
        <SegmentedControl size="xs" aria-label="Figures" value={shownGroup} data={groups} onChange={setShownGroup} />
      }
    >
      <Key />
      <div className={styles.panels}>
        {shown.map((figure) => (
          <Intervals key={figure.key} {...{ summary, strategies, figure }} />
        ))}
      </div>
      <ScrollTable label="Values of the spread" className={classes.table}>
        <thead>
          <tr>
            <td />
            <th colSpan={5} className={classes.group}>
              {shownGroup}
            </th>
            <th colSpan={3} className={classes.group}>
              Change against {against} at the same point
            </th>
          </tr>
          <tr>
            <th scope="col" className={classes.left}>
              Strategy
            </th>
            {["Nominal", "Median", "5 %", "95 %", "Worst case", "Median", "5 %", "95 %"].map((head, index) => (
              <th key={index} scope="col">
                {head}
              </th>
            ))}
          </tr>
        </thead>
        {shown.map((figure) => (
          <tbody key={figure.key}>
            <tr>
              <th colSpan={9} scope="rowgroup" className={classes.rowGroup}>
                {figure.label} <span className={ui.dim}>{prettyUnit(figure.unit)}</span>
              </th>
            </tr>
            {strategies.map((strategy) => {
              const figureSummary = summary.strategies[strategy.id]?.figures[figure.key];
              return figureSummary && <Row key={strategy.id} {...{ summary, strategy, figure, figureSummary, opening }} />;
            })}
          </tbody>
        ))}
      </ScrollTable>
    </Card>
  );
}

interface RowProps {
  readonly summary: BatchSummary;
  readonly strategy: Strategy;
  readonly figure: Figure;
  readonly figureSummary: FigureSummary;
  readonly opening: Opening;
}

function Row({ summary, strategy, figure, figureSummary, opening }: RowProps) {
  const value = (number: number | null) => (number === null ? "–" : formatResult(number * figure.scale));
  const { margin } = figureSummary;
  const change = (percent: number) => {
    const at = margin && quantile(summary, margin, percent);
    return <td key={percent}>{typeof at === "number" ? formatPercent(at) : margin ? "–" : ""}</td>;
  };
  return (
    <tr data-strategy={strategy.id} data-figure={figure.key}>
      <th scope="row" className={classes.left}>
        <span className={classes.strategy}>
          <StrategyKey strategy={strategy} /> {strategy.label}
        </span>
      </th>
      <td>{value(figureSummary.nominal)}</td>
      <td className={classes.strong}>{value(quantile(summary, figureSummary, 50))}</td>
      <td>{value(quantile(summary, figureSummary, 5))}</td>
      <td>{value(quantile(summary, figureSummary, 95))}</td>
      <td>
        <RunButton run={figureSummary.highest} text={value(figureSummary.highest?.value ?? null)} what={`${strategy.label}, ${figure.label}: worst case`} opening={opening} />
      </td>
      {[50, 5, 95].map(change)}
    </tr>
  );
}

function Key() {
  return (
    <Text component="div" size="xs" c="dimmed" className={styles.key ?? ""}>
      <span>
        <i className={styles.keyBar} /> 5 to 95 %
      </span>
      <span>
        <i className={styles.keyBox} /> 25 to 75 %
      </span>
      <span>
        <i className={styles.keyMedian} /> median
      </span>
      <span>
        <i className={styles.keyNominal} /> nominal: the scenario itself
      </span>
      <span>
        <i className={styles.keyWorst} /> worst case
      </span>
    </Text>
  );
}
