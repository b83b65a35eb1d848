/** Which uncertainty a strategy's figures follow, and in which direction. */

import { SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { Batch, BatchSummary, Strategy } from "../api/types";
import type { Figure } from "../batch/figures";
import { formatFixed } from "../units/format";
import { nameOf } from "./names";
import classes from "./robustness.module.css";
import { hasOrder } from "./study";
import { matters, ranked, type Sensitivity, type StrategySummary } from "./summary";
import { ScrollTable } from "../ui/ScrollTable";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

interface Props {
  readonly batch: Batch;
  readonly summary: BatchSummary;
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Figure[];
}

const STABILITY = "stability";

export function Matters({ batch, summary, strategies, figures }: Props) {
  const [strategyId, setStrategyId] = useState<string>(summary.baseline);
  const [of, setOf] = useState<"value" | "margin">("value");
  const strategy = strategies.find(({ id }) => id === strategyId) ?? strategies[0];
  const results = strategy && summary.strategies[strategy.id];
  if (!strategy || !results || !batch.fields.some(({ name }) => hasOrder(name))) return null;
  const against = strategies.find(({ id }) => id === summary.baseline)?.label ?? "";
  const margins = of === "margin" && strategy.id !== summary.baseline;
  const rows = ranked(sensitivitiesOf(results, figures, margins));
  return (
    <Card
      aria-label="Which uncertainty matters"
      title="Which uncertainty matters"
      tools={
        <>
          <SegmentedControl size="xs" aria-label="Strategy" className={classes.segments ?? ""} value={strategy.id} data={strategies.map(({ id, label }) => ({ value: id, label }))} onChange={setStrategyId} />
          {strategy.id !== summary.baseline && (
            <SegmentedControl
              size="xs"
              aria-label="What follows"
              className={classes.segments ?? ""}
              value={of}
              data={[
                { value: "value", label: "its value" },
                { value: "margin", label: `its change against ${against}` },
              ]}
              onChange={(next) => setOf(next === "margin" ? "margin" : "value")}
            />
          )}
        </>
      }
    >
      <Text size="xs" c="dimmed" className={ui.note ?? ""}>
        How much of a figure’s variation one field alone explains, in % of the ranks’ variance (Kruskal–Wallis), and Spearman’s rank correlation: + means that more of the field is worse. A field without a number is
        no more than chance makes (p ≥ 0.001). Fields the strategy does not read are left out.
      </Text>
      {rows.length === 0 ? (
        <Text size="sm" c="dimmed" className={ui.note ?? ""}>
          Too few points have run, or nothing that varies reaches this strategy.
        </Text>
      ) : (
        <ScrollTable label="What matters" className={classes.table}>
          <thead>
            <tr>
              <td />
              {[...new Set(figures.map(({ group }) => group))].map((group) => (
                <th key={group} colSpan={figures.filter((each) => each.group === group).length} className={classes.group}>
                  {group}
                </th>
              ))}
              {!margins && <td />}
            </tr>
            <tr>
              <th scope="col" className={classes.left}>
                Field
              </th>
              {figures.map(({ key, label }) => (
                <th key={key} scope="col" className={classes.leadColumn}>
                  {label}
                </th>
              ))}
              {!margins && (
                <th scope="col" className={classes.leadColumn}>
                  Least damping
                </th>
              )}
            </tr>
          </thead>
          <tbody>
            {rows.map(({ field, cells }) => (
              <tr key={field} data-field={field}>
                <th scope="row" className={classes.left}>
                  <span className={classes.fieldName}>{nameOf(field, batch.fields)}</span>
                </th>
                {[...figures.map(({ key }) => key), ...(margins ? [] : [STABILITY])].map((key) => (
                  <SensitivityCell key={key} figure={key} sensitivity={cells[key]} />
                ))}
              </tr>
            ))}
          </tbody>
        </ScrollTable>
      )}
    </Card>
  );
}

function sensitivitiesOf({ figures: results, stability }: StrategySummary, figures: readonly Figure[], margins: boolean): Readonly<Record<string, readonly Sensitivity[]>> {
  const own = figures.map(({ key }) => [key, (margins ? results[key]?.margin?.sensitivity : results[key]?.sensitivity) ?? []] as const);
  return Object.fromEntries(margins ? own : [...own, [STABILITY, stability.sensitivity] as const]);
}

function SensitivityCell({ figure, sensitivity }: { readonly figure: string; readonly sensitivity: Sensitivity | undefined }) {
  if (!sensitivity || !matters(sensitivity)) {
    return (
      <td data-cell={figure} className={ui.dim}>
        ·
      </td>
    );
  }
  const share = Math.round(100 * sensitivity.effect);
  return (
    <td data-cell={figure} className={classes.follow} style={{ background: `color-mix(in srgb, var(--accent) ${Math.min(55, share)}%, transparent)` }}>
      <span className={classes.strong}>{share < 1 ? "<1" : share}&#8239;%</span>
      <span className={classes.rho}>{`${sensitivity.spearman < 0 ? "" : "+"}${formatFixed(sensitivity.spearman, 2)}`}</span>
    </td>
  );
}
