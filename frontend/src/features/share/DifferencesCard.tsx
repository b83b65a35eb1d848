/** What this version computes otherwise than the one that made the shared result. */

import { CloseButton, Text } from "@mantine/core";
import type { Catalogue, FigureTemplate, Run, Strategy } from "../../api/types";
import { formatPercent } from "../tables/change";
import { StrategyName } from "../../ui/StrategyKey";
import { formatNumber, prettyUnit } from "../../units/format";
import { compareRuns, type Difference, type Figure } from "./differences";
import classes from "./share.module.css";
import { Card } from "../../ui/Card";
import { DataTable } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly then: Run;
  readonly now: Run;
  readonly strategies: readonly Strategy[];
  readonly catalogue: Catalogue;
  readonly figures: Readonly<Record<string, FigureTemplate>>;
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

export function DifferencesCard({ then, now, strategies, catalogue, figures, onClose }: Props) {
  const { differences, compared, failed } = compareRuns(then, now, catalogue, figures);
  const same = then.core_version === now.core_version;
  return (
    <Card mt="0.6rem" aria-label="Differences">
      <header className={classes.differencesHeader}>
        <div role="status">
          <Text component="h2" fw={650} size="sm">
            {differences.length === 0 ? "No differences" : `${differences.length} of ${compared} figures differ`}
          </Text>
          <Text size="xs" c="dimmed">
            {same
              ? `The same version, core ${now.core_version}, computed both: equal numbers are what to expect.`
              : `Core ${then.core_version} then, core ${now.core_version} now; ${compared} metrics compared, the largest change first.`}
          </Text>
        </div>
        <CloseButton size="sm" aria-label="Close the differences" onClick={onClose} />
      </header>
      {failed.map((line) => (
        <Text key={line} size="sm" px="0.9rem" pb="xs" c="var(--danger)">
          {line}
        </Text>
      ))}
      {differences.length > 0 && <DifferencesTable differences={differences} strategies={strategies} />}
    </Card>
  );
}

function DifferencesTable({
  differences,
  strategies,
}: {
  readonly differences: readonly Difference[];
  readonly strategies: readonly Strategy[];
}) {
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
          cell: ({ metric, unit }) => (
            <>
              {metric} <span className={ui.dim}>{prettyUnit(unit)}</span>
            </>
          ),
        },
        { key: "then", head: "Then", cell: ({ then }) => show(then) },
        { key: "now", head: "Now", cell: ({ now }) => show(now) },
        { key: "change", head: "Change", cell: change },
      ]}
    />
  );
}
