/** Which uncertainty a strategy's figures follow, and in which direction. */

import { SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { Batch, BatchSummary, Strategy } from "../api/types";
import type { Figure } from "../batch/figures";
import { formatFixed } from "../units/format";
import { nameOf } from "./names";
import classes from "./robustness.module.css";
import { hasOrder } from "./study";
import { matters, ranked, type Followed, type StrategySummary } from "./summary";

interface Props {
  readonly batch: Batch;
  readonly summary: BatchSummary;
  readonly strategies: readonly Strategy[];
  readonly figures: readonly Figure[];
}

const STABILITY = "stability";

export function Matters({ batch, summary, strategies, figures }: Props) {
  const [chosen, setChosen] = useState<string>(summary.baseline);
  const [of, setOf] = useState<"value" | "margin">("value");
  const strategy = strategies.find(({ id }) => id === chosen) ?? strategies[0];
  const found = strategy && summary.strategies[strategy.id];
  if (!strategy || !found || !batch.fields.some(({ name }) => hasOrder(name))) return null;
  const against = strategies.find(({ id }) => id === summary.baseline)?.label ?? "";
  const margins = of === "margin" && strategy.id !== summary.baseline;
  const rows = ranked(followedOf(found, figures, margins));
  return (
    <section className={classes.card} aria-label="Which uncertainty matters">
      <div className={classes.cardHead}>
        <h2 className={classes.heading}>Which uncertainty matters</h2>
        <SegmentedControl size="xs" aria-label="Strategy" className={classes.segments ?? ""} value={strategy.id} data={strategies.map(({ id, label }) => ({ value: id, label }))} onChange={setChosen} />
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
      </div>
      <Text size="xs" c="dimmed" className={classes.cardText ?? ""}>
        How much of a figure’s variation one field alone explains, in % of the ranks’ variance (Kruskal–Wallis), and Spearman’s rank correlation: + means that more of the field is worse. A field without a number is
        no more than chance makes (p ≥ 0.001). Fields the strategy does not read are left out.
      </Text>
      {rows.length === 0 ? (
        <Text size="sm" c="dimmed" className={classes.cardText ?? ""}>
          Too few points have run, or nothing that varies reaches this strategy.
        </Text>
      ) : (
        <div className={classes.scroll} tabIndex={0} role="region" aria-label="What matters">
          <table className={classes.table}>
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
              {rows.map(({ field, found: cells }) => (
                <tr key={field} data-field={field}>
                  <th scope="row" className={classes.left}>
                    <span className={classes.fieldName}>{nameOf(field, batch.fields)}</span>
                  </th>
                  {[...figures.map(({ key }) => key), ...(margins ? [] : [STABILITY])].map((key) => (
                    <FollowCell key={key} figure={key} followed={cells[key]} />
                  ))}
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </section>
  );
}

function followedOf({ figures: found, stability }: StrategySummary, figures: readonly Figure[], margins: boolean): Readonly<Record<string, readonly Followed[]>> {
  const own = figures.map(({ key }) => [key, (margins ? found[key]?.margin?.sensitivity : found[key]?.sensitivity) ?? []] as const);
  return Object.fromEntries(margins ? own : [...own, [STABILITY, stability.sensitivity] as const]);
}

function FollowCell({ figure, followed }: { readonly figure: string; readonly followed: Followed | undefined }) {
  if (!followed || !matters(followed)) {
    return (
      <td data-cell={figure} className={classes.dim}>
        ·
      </td>
    );
  }
  const share = Math.round(100 * followed.effect);
  return (
    <td data-cell={figure} className={classes.follow} style={{ background: `color-mix(in srgb, var(--accent) ${Math.min(55, share)}%, transparent)` }}>
      <span className={classes.strong}>{share < 1 ? "<1" : share}&#8239;%</span>
      <span className={classes.rho}>{`${followed.spearman < 0 ? "" : "+"}${formatFixed(followed.spearman, 2)}`}</span>
    </td>
  );
}
