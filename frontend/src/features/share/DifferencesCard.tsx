/** What this version computes otherwise than the one that made the shared result. */

import { CloseButton, Group, Text } from "@mantine/core";
import type { Run, Strategy, StrategyId, Summary } from "../../api/types";
import { formatPercent } from "../tables/change";
import { StrategyName, NameWithUnit } from "../../ui/StrategyKey";
import { formatNumber } from "../../units/format";
import { Card } from "../../ui/Card";
import { DataTable } from "../../ui/DataTable";
import { fullName, type Metric } from "../../server/metrics";
import { useCatalogues } from "../../server/useCatalogues";
import { metricPath, valueAt } from "../../lab/metricPath";
import { Note } from "../../ui/Messages";

interface Props {
  readonly then: Run;
  readonly now: Run;
  readonly strategies: readonly Strategy[];
  readonly onClose: () => void;
}

/** Enough digits to see a small change, no more than are worth reading. */
const DIGITS = 6;

function show(value: Figure): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  return value === null ? "–" : formatNumber(value, DIGITS);
}

function change({ then, now }: Difference): string {
  if (typeof then !== "number" || typeof now !== "number") return "–";
  const moved = now - then;
  const size = `${moved > 0 ? "+" : ""}${formatNumber(moved)}`;
  if (then === 0) return size;
  const percent = (100 * moved) / Math.abs(then);
  return Math.abs(percent) < 0.05 ? size : `${size} (${formatPercent(percent)})`;
}

export function DifferencesCard({ then, now, strategies, onClose }: Props) {
  const { differences, compared, failed } = compareRuns(then, now, useCatalogues().figures);
  const same = then.core_version === now.core_version;
  return (
    <Card mt="0.6rem" aria-label="Differences">
      <Group
        component="header"
        gap="0.6rem"
        align="flex-start"
        justify="space-between"
        wrap="nowrap"
        p="0.6rem 0.6rem 0.6rem 0.9rem"
      >
        <div role="status">
          <Text component="h2" fw={650}>
            {differences.length === 0 ? "No differences" : `${differences.length} of ${compared} figures differ`}
          </Text>
          <Note>
            {same
              ? `The same version, core ${now.core_version}, computed both: equal numbers are what to expect.`
              : `Core ${then.core_version} then, core ${now.core_version} now; ${compared} metrics compared, the largest change first.`}
          </Note>
        </div>
        <CloseButton size="sm" data-unprinted aria-label="Close the differences" onClick={onClose} />
      </Group>
      {failed.map((line) => (
        <Text key={line} px="0.9rem" pb="xs" c="var(--danger)">
          {line}
        </Text>
      ))}
      {differences.length > 0 && <DifferencesTable differences={differences} strategies={strategies} />}
    </Card>
  );
}

interface DifferencesTableProps {
  readonly differences: readonly Difference[];
  readonly strategies: readonly Strategy[];
}

function DifferencesTable({ differences, strategies }: DifferencesTableProps) {
  return (
    <DataTable
      label="Differences by metric"
      height="19rem"
      attributes={{ "data-dense": true }}
      rows={differences}
      rowKey={({ strategy, metric }) => `${strategy} ${metric}`}
      columns={[
        {
          key: "strategy",
          head: "Strategy",
          text: true,
          cell({ strategy: id }) {
            const strategy = strategies.find((each) => each.id === id);
            return strategy ? <StrategyName strategy={strategy} /> : id;
          },
        },
        {
          key: "metric",
          head: "Metric",
          text: true,
          cell: ({ metric, unit }) => <NameWithUnit name={metric} unit={unit} />,
        },
        { key: "then", head: "Then", cell: ({ then }) => show(then) },
        { key: "now", head: "Now", cell: ({ now }) => show(now) },
        { key: "change", head: "Change", cell: change },
      ]}
    />
  );
}

/** The same scenario computed twice: which figures differ, the largest change first. */
export type Figure = number | boolean | null;

interface Difference {
  readonly strategy: StrategyId;
  readonly metric: string;
  readonly unit: string;
  readonly then: Figure;
  readonly now: Figure;
  /** Relative to the larger of both, 0 to 2; infinite where one of them is not a number. */
  readonly size: number;
}

interface Comparison {
  readonly differences: readonly Difference[];
  /** How many figures were compared. */
  readonly compared: number;
  /** Strategies that failed then or now, in words. */
  readonly failed: readonly string[];
}

/** In the unit the page shows it in; `undefined` of a result that does not have it. */
function figureOf(summary: Summary, { key, scale }: Metric): Figure | undefined {
  const [, event] = /^events[.](.+)/.exec(key) ?? [];
  const value = event === undefined ? valueAt(summary, metricPath(key)) : summary.events[event];
  return typeof value === "number" ? value * scale : value;
}

/** Room for rounding, as `ridelab compare` leaves it: a part of the value, and an amount in SI units. */
const [RELATIVE, ABSOLUTE] = [1e-6, 1e-9];

function sizeOf(then: Figure, now: Figure, scale: number): number {
  if (then === now) return 0;
  if (typeof then !== "number" || typeof now !== "number") return Infinity;
  if (Math.abs(now - then) <= Math.max(ABSOLUTE * scale, RELATIVE * Math.abs(then))) return 0;
  return Math.abs(now - then) / Math.max(Math.abs(then), Math.abs(now));
}

export function compareRuns(then: Run, now: Run, metrics: readonly Metric[]): Comparison {
  const differences: Difference[] = [];
  const failed: string[] = [];
  let compared = 0;
  for (const [strategy, before] of Object.entries(then.strategies)) {
    const after = now.strategies[strategy];
    if (after === undefined) continue;
    if (before.status !== "ok" || after.status !== "ok") {
      const say = (entry: typeof before) => (entry.status === "ok" ? "computed" : `failed (${entry.reason})`);
      failed.push(`${strategy}: ${say(before)} then, ${say(after)} now`);
      continue;
    }
    for (const metric of metrics) {
      const [value, current = null] = [figureOf(before, metric), figureOf(after, metric)];
      if (value === undefined) continue;
      compared += 1;
      const size = sizeOf(value, current, metric.scale);
      if (size > 0)
        differences.push({ strategy, metric: fullName(metric), unit: metric.unit, then: value, now: current, size });
    }
  }
  return { differences: differences.sort((a, b) => b.size - a.size), compared, failed };
}
