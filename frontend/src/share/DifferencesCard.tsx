/** What this version computes otherwise than the one that made the shared result. */

import { CloseButton, Text } from "@mantine/core";
import type { Catalogue, FigureTemplate, Run, Strategy } from "../api/types";
import { formatPercent } from "../tables/change";
import { StrategyKey } from "../tables/StrategyKey";
import tables from "../tables/tables.module.css";
import { formatNumber, prettyUnit } from "../units/format";
import { compareRuns, type Difference, type Figure } from "./differences";
import classes from "./share.module.css";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

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
    <Card className={classes.differences ?? ""} aria-label="Differences">
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
        <Text key={line} size="sm" className={classes.problem ?? ""}>
          {line}
        </Text>
      ))}
      {differences.length > 0 && <DifferencesTable differences={differences} strategies={strategies} />}
    </Card>
  );
}

function DifferencesTable({ differences, strategies }: { readonly differences: readonly Difference[]; readonly strategies: readonly Strategy[] }) {
  return (
    <div className={classes.differencesScroll} tabIndex={0} role="region" aria-label="Differences by metric">
      <table className={`${ui.table} ${classes.differencesTable}`}>
        <thead>
          <tr>
            {["Strategy", "Metric", "Then", "Now", "Change"].map((title) => (
              <th key={title} scope="col">
                {title}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {differences.map((difference) => {
            const strategy = strategies.find(({ id }) => id === difference.strategy);
            return (
              <tr key={`${difference.strategy} ${difference.metric}`}>
                <th scope="row">
                  {strategy && <StrategyKey strategy={strategy} />} {strategy?.label ?? difference.strategy}
                </th>
                <td>
                  {difference.metric} <span className={tables.columnUnit}>{prettyUnit(difference.unit)}</span>
                </td>
                <td>{show(difference.then)}</td>
                <td>{show(difference.now)}</td>
                <td>{change(difference)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}
