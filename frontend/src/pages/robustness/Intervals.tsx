/** One figure under every strategy on one scale from zero: quantiles as bars. */

import { stepAbove } from "../../lib/steps";
import { Box } from "@mantine/core";
import type { BatchSummary, Strategy } from "../../api/types";
import { fullName, type Metric } from "../../server/metrics";
import { ChartButton } from "../../plots/FigureButton";
import { formatNumber, formatResult, prettyUnit } from "../../units/format";
import { spreadChart } from "./paperSpread";
import { quantile, type FigureSummary, type StudyParts } from "./summary";
import styles from "./bars.module.css";
import ui from "../../ui/ui.module.css";

interface Props extends Pick<StudyParts, "summary" | "strategies"> {
  readonly figure: Metric;
}

export function Intervals({ summary, strategies, figure }: Props) {
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
      <Box component="figcaption" mb="0.2rem" fz="sm" fw={600}>
        {figure.label} <span className={ui.dim}>{prettyUnit(figure.unit)}</span>{" "}
        <ChartButton
          title={fullName(figure)}
          file={`ridelab-${summary.batch}-spread-${figure.key}`}
          draw={() => spreadChart(summary, strategies, figure)}
        />
      </Box>
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
