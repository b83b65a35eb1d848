/** At how many points the baseline strategy is better than each other one, and what is left of its lead. */

import { Box, Text } from "@mantine/core";
import type { BatchSummary, Strategy, StrategyId } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import { StrategyName } from "../../ui/StrategyKey";
import classes from "./robustness.module.css";
import { quantile, type Margin } from "./summary";
import { DataTable, type Column } from "../../ui/DataTable";
import { Choice, labelled } from "../../ui/Entry";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import type { StudyParts } from "./props";

interface Props extends Pick<StudyParts, "summary" | "strategies" | "figures"> {
  readonly onBaseline: (baseline: StrategyId) => void;
}

export function Leads({ summary, strategies, figures, onBaseline }: Props) {
  const baseline = strategies.find(({ id }) => id === summary.baseline);
  const others = strategies.filter(({ id }) => id !== summary.baseline);
  if (!baseline || others.length === 0) return null;
  return (
    <Card
      aria-label="Who keeps the lead"
      title={`Where ${baseline.label} is better`}
      tools={<Choice aria-label="Baseline" value={summary.baseline} data={labelled(strategies)} onPick={onBaseline} />}
    >
      <Text size="xs" c="dimmed" className={ui.note ?? ""}>
        Share of the points at which {baseline.label} has the lower value; below, how much higher the other strategy is:
        in the scenario itself, then the median and the range of 90 % of the points.
      </Text>
      <DataTable
        label="Leads"
        rows={others}
        rowKey={({ id }) => id}
        rowAttributes={({ id }) => ({ "data-strategy": id })}
        columns={[
          { key: "strategy", head: "Against", text: true, cell: (strategy) => <StrategyName strategy={strategy} /> },
          ...figures.map(({ key, label, group }): Column<Strategy> => ({
            key,
            head: label,
            group,
            attributes: () => ({ "data-cell": key }),
            cell: ({ id }) => <Lead summary={summary} margin={summary.strategies[id]?.figures[key]?.margin} />,
          })),
        ]}
      />
    </Card>
  );
}

const whole = (share: number) => `${Math.round(100 * share)}\u2009%`;

const plain = (percent: number | null) =>
  percent === null ? "–" : formatPercent(Math.round(percent)).replace(".0", "");

function Lead({ summary, margin }: { readonly summary: BatchSummary; readonly margin: Margin | null | undefined }) {
  // The margin is the other strategy's: where that is worse, the baseline is better.
  if (typeof margin?.worse !== "number" || typeof margin.better !== "number") return "–";
  const { worse, better } = margin;
  return (
    <>
      <Box component="span" display="block" fw={650}>
        {whole(worse)}
      </Box>
      <span className={classes.shareBar} aria-hidden data-behind={worse < better || undefined}>
        <span style={{ width: `${100 * worse}%` }} />
      </span>
      <span className={classes.lost}>
        {plain(margin.nominal)} → <b>{plain(quantile(summary, margin, 50))}</b>
      </span>
      <span className={classes.lost}>
        {plain(quantile(summary, margin, 5))} … {plain(quantile(summary, margin, 95))}
      </span>
    </>
  );
}
