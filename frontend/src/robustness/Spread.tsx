/** Every figure's spread under each strategy: bars to compare, a table to read, the worst case to open. */

import { SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { BatchSummary, Strategy } from "../api/types";
import type { Figure } from "../batch/figures";
import { formatPercent } from "../tables/change";
import { StrategyKey } from "../tables/StrategyKey";
import { formatResult, prettyUnit } from "../units/format";
import { Intervals } from "./Intervals";
import { PlaceButton } from "./PlaceButton";
import classes from "./robustness.module.css";
import { quantile, type FigureSummary } from "./summary";
import type { Opening } from "./useOpenRun";
import styles from "./bars.module.css";

interface Props {
  readonly summary: BatchSummary;
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Figure[];
  readonly opening: Opening;
}

export function Spread({ summary, strategies, figures, opening }: Props) {
  const groups = [...new Set(figures.map(({ group }) => group))];
  const [chosen, setChosen] = useState(groups[0] ?? "");
  const shown = figures.filter(({ group }) => group === chosen);
  const against = strategies.find(({ id }) => id === summary.baseline)?.label ?? summary.baseline;
  return (
    <section className={classes.card} aria-label="Spread">
      <div className={classes.cardHead}>
        <h2 className={classes.heading}>How far the figures spread</h2>
        <SegmentedControl size="xs" aria-label="Figures" value={chosen} data={groups} onChange={setChosen} />
      </div>
      <Key />
      <div className={styles.panels}>
        {shown.map((figure) => (
          <Intervals key={figure.key} {...{ summary, strategies, figure }} />
        ))}
      </div>
      <div className={classes.scroll} tabIndex={0} role="region" aria-label="Values of the spread">
        <table className={classes.table}>
          <thead>
            <tr>
              <td />
              <th colSpan={5} className={classes.group}>
                {chosen}
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
                  {figure.label} <span className={classes.dim}>{prettyUnit(figure.unit)}</span>
                </th>
              </tr>
              {strategies.map((strategy) => {
                const found = summary.strategies[strategy.id]?.figures[figure.key];
                return found && <Row key={strategy.id} {...{ summary, strategy, figure, found, opening }} />;
              })}
            </tbody>
          ))}
        </table>
      </div>
    </section>
  );
}

interface RowProps {
  readonly summary: BatchSummary;
  readonly strategy: Strategy;
  readonly figure: Figure;
  readonly found: FigureSummary;
  readonly opening: Opening;
}

function Row({ summary, strategy, figure, found, opening }: RowProps) {
  const value = (number: number | null) => (number === null ? "–" : formatResult(number * figure.scale));
  const { margin } = found;
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
      <td>{value(found.nominal)}</td>
      <td className={classes.strong}>{value(quantile(summary, found, 50))}</td>
      <td>{value(quantile(summary, found, 5))}</td>
      <td>{value(quantile(summary, found, 95))}</td>
      <td>
        <PlaceButton place={found.highest} text={value(found.highest?.value ?? null)} what={`${strategy.label}, ${figure.label}: worst case`} opening={opening} />
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
