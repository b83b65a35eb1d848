/** What must not happen at all: an unstable loop, too much travel, a wheel off the road, a run without a result. */

import { Text } from "@mantine/core";
import type { BatchSummary, Strategy } from "../api/types";
import { StrategyKey } from "../tables/StrategyKey";
import { formatFixed, formatResult, formatWhole } from "../units/format";
import { PlaceButton } from "./PlaceButton";
import classes from "./robustness.module.css";
import { AIRBORNE, quantile, TRAVEL, type FigureSummary } from "./summary";
import type { Opening } from "./useOpenRun";

interface Props {
  readonly summary: BatchSummary;
  readonly strategies: readonly Strategy[];
  readonly opening: Opening;
}

export function Limits({ summary, strategies, opening }: Props) {
  const reasons = strategies.flatMap(({ id, label }) => Object.entries(summary.strategies[id]?.reasons ?? {}).map(([reason, times]) => ({ label, reason, times })));
  return (
    <section className={classes.card} aria-label="Limits and stability">
      <h2 className={classes.heading} data-alone>
        Limits and stability
      </h2>
      <div className={classes.scroll} tabIndex={0} role="region" aria-label="Limits">
        <table className={classes.table}>
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
              const found = summary.strategies[strategy.id];
              if (!found) return null;
              const { stability, figures } = found;
              const median = quantile(summary, stability, 50);
              return (
                <tr key={strategy.id} data-strategy={strategy.id}>
                  <th scope="row" className={classes.left}>
                    <span className={classes.strategy}>
                      <StrategyKey strategy={strategy} /> {strategy.label}
                    </span>
                  </th>
                  {stability.known === 0 ? (
                    <td colSpan={4} className={classes.dim}>
                      not judged: this controller is no linear law
                    </td>
                  ) : (
                    <>
                      <td>{stability.nominal === null ? "–" : formatFixed(stability.nominal, 2)}</td>
                      <td>{median === null ? "–" : formatFixed(median, 2)}</td>
                      <td>
                        <PlaceButton place={stability.lowest} text={stability.lowest ? formatFixed(stability.lowest.value, 2) : "–"} what={`${strategy.label}: least damping`} opening={opening} />
                      </td>
                      <td data-bad={stability.unstable > 0 || undefined}>{times(stability.unstable, stability.known)}</td>
                    </>
                  )}
                  <Event found={figures[TRAVEL]} unit="mm" what={`${strategy.label}: travel over the limit`} opening={opening} />
                  <Event found={figures[AIRBORNE]} unit="ms" what={`${strategy.label}: airborne`} opening={opening} />
                  <td data-bad={found.failed > 0 || undefined}>{formatWhole(found.failed)}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
      {reasons.map(({ label, reason, times: count }) => (
        <Text key={`${label} ${reason}`} size="xs" className={`${classes.error ?? ""} ${classes.cardText ?? ""}`}>
          {label}, {formatWhole(count)} failed: {reason}
        </Text>
      ))}
      <Text size="xs" c="dimmed" className={classes.cardText ?? ""}>
        Of the loop’s modes near rest, where no limit binds: 1 does not oscillate, 0 oscillates for ever, below 0 is unstable. Preview is not fed back, so no error of it can make a loop unstable.
      </Text>
    </section>
  );
}

const times = (count: number, of: number) => (count === 0 ? "no point" : `${formatWhole(count)} of ${formatWhole(of)}`);

interface EventProps {
  readonly found: FigureSummary | undefined;
  readonly unit: string;
  readonly what: string;
  readonly opening: Opening;
}

function Event({ found, unit, what, opening }: EventProps) {
  if (!found) return <td colSpan={2}>–</td>;
  const happens = found.above_zero > 0;
  return (
    <>
      <td data-bad={happens || undefined}>{times(found.above_zero, found.n)}</td>
      <td>{happens && found.highest ? <PlaceButton place={found.highest} text={`${formatResult(found.highest.value)}\u00a0${unit}`} what={what} opening={opening} /> : "–"}</td>
    </>
  );
}
