/** What must not happen at all: an unstable loop, too much travel, a wheel off the road, a run without a result. */

import { Text } from "@mantine/core";
import type { BatchSummary, Strategy } from "../api/types";
import { StrategyKey } from "../tables/StrategyKey";
import { formatFixed, formatResult, formatWhole } from "../units/format";
import { RunButton } from "./RunButton";
import classes from "./robustness.module.css";
import { AIRBORNE, quantile, TRAVEL, type FigureSummary } from "./summary";
import type { Opening } from "../batch/useOpenRun";
import { ScrollTable } from "../ui/ScrollTable";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

interface Props {
  readonly summary: BatchSummary;
  readonly strategies: readonly Strategy[];
  readonly opening: Opening;
}

export function Limits({ summary, strategies, opening }: Props) {
  const reasons = strategies.flatMap(({ id, label }) => Object.entries(summary.strategies[id]?.reasons ?? {}).map(([reason, times]) => ({ label, reason, times })));
  return (
    <Card aria-label="Limits and stability" title="Limits and stability">
      <ScrollTable label="Limits" className={classes.table}>
        <thead>
          <tr>
            <td />
            <th colSpan={4} className={classes.group}>
              Least damping ratio of the closed loop
            </th>
            <th colSpan={2} className={classes.group}>
              Travel over the limit
            </th>
            <th colSpan={2} className={classes.group}>
              A tyre airborne
            </th>
            <th className={classes.group}>Runs</th>
          </tr>
          <tr>
            <th scope="col" className={classes.left}>
              Strategy
            </th>
            <th scope="col">nominal</th>
            <th scope="col">median</th>
            <th scope="col">lowest</th>
            <th scope="col">unstable at</th>
            <th scope="col">at</th>
            <th scope="col">at most</th>
            <th scope="col">at</th>
            <th scope="col">at most</th>
            <th scope="col">failed</th>
          </tr>
        </thead>
        <tbody>
          {strategies.map((strategy) => {
            const results = summary.strategies[strategy.id];
            if (!results) return null;
            const { stability, figures } = results;
            const median = quantile(summary, stability, 50);
            return (
              <tr key={strategy.id} data-strategy={strategy.id}>
                <th scope="row" className={classes.left}>
                  <span className={classes.strategy}>
                    <StrategyKey strategy={strategy} /> {strategy.label}
                  </span>
                </th>
                {stability.known === 0 ? (
                  <td colSpan={4} className={ui.dim}>
                    not judged: this controller is no linear law
                  </td>
                ) : (
                  <>
                    <td>{stability.nominal === null ? "–" : formatFixed(stability.nominal, 2)}</td>
                    <td>{median === null ? "–" : formatFixed(median, 2)}</td>
                    <td>
                      <RunButton run={stability.lowest} text={stability.lowest ? formatFixed(stability.lowest.value, 2) : "–"} what={`${strategy.label}: least damping`} opening={opening} />
                    </td>
                    <td data-bad={stability.unstable > 0 || undefined}>{times(stability.unstable, stability.known)}</td>
                  </>
                )}
                <Event results={figures[TRAVEL]} unit="mm" what={`${strategy.label}: travel over the limit`} opening={opening} />
                <Event results={figures[AIRBORNE]} unit="ms" what={`${strategy.label}: airborne`} opening={opening} />
                <td data-bad={results.failed > 0 || undefined}>{formatWhole(results.failed)}</td>
              </tr>
            );
          })}
        </tbody>
      </ScrollTable>
      {reasons.map(({ label, reason, times: count }) => (
        <Text key={`${label} ${reason}`} size="xs" className={`${ui.error ?? ""} ${ui.note ?? ""}`}>
          {label}, {formatWhole(count)} failed: {reason}
        </Text>
      ))}
      <Text size="xs" c="dimmed" className={ui.note ?? ""}>
        Of the loop’s modes near rest, where no limit binds: 1 does not oscillate, 0 oscillates for ever, below 0 is unstable. Preview is not fed back, so no error of it can make a loop unstable.
      </Text>
    </Card>
  );
}

const times = (count: number, of: number) => (count === 0 ? "no point" : `${formatWhole(count)} of ${formatWhole(of)}`);

interface EventProps {
  readonly results: FigureSummary | undefined;
  readonly unit: string;
  readonly what: string;
  readonly opening: Opening;
}

function Event({ results, unit, what, opening }: EventProps) {
  if (!results) return <td colSpan={2}>–</td>;
  const happens = results.above_zero > 0;
  return (
    <>
      <td data-bad={happens || undefined}>{times(results.above_zero, results.n)}</td>
      <td>{happens && results.highest ? <RunButton run={results.highest} text={`${formatResult(results.highest.value)}\u00a0${unit}`} what={what} opening={opening} /> : "–"}</td>
    </>
  );
}
