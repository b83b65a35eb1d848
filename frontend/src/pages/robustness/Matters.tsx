/** Which uncertainty a strategy's figures follow, and in which direction. */

import { Box, SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { Batch } from "../../api/types";
import type { Metric } from "../../server/metrics";
import { formatFixed } from "../../units/format";
import { nameOf } from "./names";
import { humanise } from "../../scenario/schema";
import { hasOrder } from "./study";
import { matters, ranked, type Ranked, type Sensitivity, type StrategySummary, type StudyParts } from "./summary";
import { DataTable, type Column } from "../../ui/DataTable";
import { labelled } from "../../ui/Entry";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { Note } from "../../ui/Messages";

type Props = Pick<StudyParts, "batch" | "summary" | "strategies" | "figures">;

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
          <SegmentedControl
            aria-label="Strategy"
            maw="100%"
            style={{ overflowX: "auto" }}
            value={strategy.id}
            data={labelled(strategies)}
            onChange={setStrategyId}
          />
          {strategy.id !== summary.baseline && (
            <SegmentedControl
              aria-label="What follows"
              maw="100%"
              style={{ overflowX: "auto" }}
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
      <Note className={ui.note ?? ""}>
        How much of a figure’s variation one field alone explains, in % of the ranks’ variance (Kruskal–Wallis), and
        Spearman’s rank correlation: + means that more of the field is worse. A field without a number is no more than
        chance makes (p ≥ 0.001). Fields the strategy does not read are left out.
      </Note>
      {rows.length === 0 ? (
        <Text c="dimmed" className={ui.note ?? ""}>
          Too few points have run, or nothing that varies reaches this strategy.
        </Text>
      ) : (
        <DataTable
          label="What matters"
          rows={rows}
          rowKey={({ field }) => field}
          rowAttributes={({ field }) => ({ "data-field": field })}
          columns={columnsOf(batch, figures, margins)}
        />
      )}
    </Card>
  );
}

function sensitivitiesOf(
  { figures: results, stability }: StrategySummary,
  figures: readonly Metric[],
  margins: boolean,
): Readonly<Record<string, readonly Sensitivity[]>> {
  const own = figures.map(
    ({ key }) => [key, (margins ? results[key]?.margin?.sensitivity : results[key]?.sensitivity) ?? []] as const,
  );
  return Object.fromEntries(margins ? own : [...own, [STABILITY, stability.sensitivity] as const]);
}

function columnsOf(batch: Batch, figures: readonly Metric[], margins: boolean): readonly Column<Ranked>[] {
  const sensitivity = (key: string, head: string, group?: string): Column<Ranked> => ({
    key,
    head,
    group,
    attributes: ({ cells }) => ({ "data-cell": key, style: { background: shadeOf(cells[key]) } }),
    cell: ({ cells }) => <Share sensitivity={cells[key]} />,
  });
  return [
    {
      key: "field",
      head: "Field",
      text: true,
      cell: ({ field }) => humanise(nameOf(field, batch.fields)),
    },
    ...figures.map(({ key, label, group }) => sensitivity(key, label, group)),
    ...(margins ? [] : [sensitivity(STABILITY, "Least damping")]),
  ];
}

const shareOf = (sensitivity: Sensitivity | undefined) =>
  sensitivity && matters(sensitivity) ? Math.round(100 * sensitivity.effect) : undefined;

function shadeOf(sensitivity: Sensitivity | undefined): string | undefined {
  const share = shareOf(sensitivity);
  return share === undefined ? undefined : `color-mix(in srgb, var(--accent) ${Math.min(55, share)}%, transparent)`;
}

function Share({ sensitivity }: { readonly sensitivity: Sensitivity | undefined }) {
  const share = shareOf(sensitivity);
  if (!sensitivity || share === undefined) return <span className={ui.dim}>·</span>;
  return (
    <>
      <b>{share < 1 ? "<1" : share}&#8239;%</b>
      <Box
        component="span"
        display="block"
        fz="xs"
      >{`${sensitivity.spearman < 0 ? "" : "+"}${formatFixed(sensitivity.spearman, 2)}`}</Box>
    </>
  );
}
