/** One figure under every strategy on one scale from zero: quantiles as bars. */

import type { BatchSummary, Strategy } from "../api/types";
import type { Figure } from "../batch/figures";
import { formatNumber, formatResult, prettyUnit } from "../units/format";
import classes from "./robustness.module.css";
import { scaleTo } from "./scale";
import { quantile, type FigureSummary } from "./summary";
import styles from "./bars.module.css";

interface Props {
  readonly summary: BatchSummary;
  readonly strategies: readonly Strategy[];
  readonly figure: Figure;
}

export function Intervals({ summary, strategies, figure }: Props) {
  const rows = strategies.flatMap((strategy) => {
    const found = summary.strategies[strategy.id]?.figures[figure.key];
    return found ? [{ strategy, found }] : [];
  });
  const most = Math.max(0, ...rows.flatMap(({ found }) => [found.highest?.value ?? 0, found.nominal ?? 0]));
  const { end, ticks } = scaleTo(most * figure.scale);
  return (
    <figure className={styles.panel} data-figure={figure.key}>
      <figcaption className={styles.panelTitle}>
        {figure.label} <span className={classes.dim}>{prettyUnit(figure.unit)}</span>
      </figcaption>
      {rows.map(({ strategy, found }) => (
        <div key={strategy.id} className={styles.interval}>
          <span className={styles.intervalName}>{strategy.label}</span>
          <Track {...{ summary, strategy, found, figure, end }} />
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
    </figure>
  );
}

const formatTick = (tick: number) => (tick === 0 ? "0" : formatNumber(tick, 2).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, ""));

interface TrackProps {
  readonly summary: BatchSummary;
  readonly strategy: Strategy;
  readonly found: FigureSummary;
  readonly figure: Figure;
  readonly end: number;
}

function Track({ summary, strategy, found, figure: { label, unit, scale }, end }: TrackProps) {
  const place = (value: number) => `${Math.max(0, Math.min(100, (100 * value * scale) / end))}%`;
  const at = (percent: number) => quantile(summary, found, percent);
  const span = (low: number | null, high: number | null) =>
    low === null || high === null ? { display: "none" } : { left: place(low), width: `calc(${place(high)} - ${place(low)})`, background: strategy.colour };
  const [p5, p25, p50, p75, p95] = [at(5), at(25), at(50), at(75), at(95)];
  const said = (value: number | null) => (value === null ? "none" : formatResult(value * scale));
  const words = `${strategy.label}, ${label}: median ${said(p50)}, 5 % ${said(p5)}, 95 % ${said(p95)}, worst ${said(found.highest?.value ?? null)}, nominal ${said(found.nominal)} ${prettyUnit(unit)}`;
  return (
    <span className={styles.track} role="img" aria-label={words} title={words}>
      <span className={styles.bar} style={span(p5, p95)} />
      <span className={styles.box} style={span(p25, p75)} />
      {p50 !== null && <span className={styles.median} style={{ left: place(p50) }} />}
      {found.highest && <span className={styles.worst} style={{ left: place(found.highest.value), borderColor: strategy.colour }} />}
      {found.nominal !== null && <span className={styles.nominal} style={{ left: place(found.nominal) }} />}
    </span>
  );
}
