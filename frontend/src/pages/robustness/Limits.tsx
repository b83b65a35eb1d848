/** What must not happen at all: an unstable loop, too much travel, a wheel off the road, a run without a result. */

import { Text } from "@mantine/core";
import type { BatchSummary, Strategy } from "../../api/types";
import { StrategyName } from "../../ui/StrategyKey";
import { formatFixed, formatResult, formatWhole } from "../../units/format";
import { RunButton } from "./RunButton";
import { AIRBORNE, quantile, TRAVEL, type StrategySummary, type StudyParts } from "./summary";
import type { Opening } from "../../features/sweep/useOpenRun";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { Note } from "../../ui/Messages";

type Props = Pick<StudyParts, "summary" | "strategies" | "opening">;

export function Limits({ summary, strategies, opening }: Props) {
  const reasons = strategies.flatMap(({ id, label }) =>
    Object.entries(summary.strategies[id]?.reasons ?? {}).map(([reason, times]) => ({ label, reason, times })),
  );
  const rows = strategies.flatMap((strategy): Row[] => {
    const results = summary.strategies[strategy.id];
    return results ? [{ strategy, results }] : [];
  });
  return (
    <Card aria-label="Limits and stability" title="Limits and stability">
      <DataTable
        label="Limits"
        rows={rows}
        rowKey={({ strategy }) => strategy.id}
        rowAttributes={({ strategy }) => ({ "data-strategy": strategy.id })}
        columns={columnsOf(summary, opening)}
      />
      {reasons.map(({ label, reason, times: count }) => (
        <Text key={`${label} ${reason}`} size="xs" className={`${ui.error ?? ""} ${ui.note ?? ""}`}>
          {label}, {formatWhole(count)} failed: {reason}
        </Text>
      ))}
      <Note className={ui.note ?? ""}>
        Of the loop’s modes near rest, where no limit binds: 1 does not oscillate, 0 oscillates for ever, below 0 is
        unstable. Preview is not fed back, so no error of it can make a loop unstable.
      </Note>
    </Card>
  );
}

const times = (count: number, of: number) => (count === 0 ? "no point" : `${formatWhole(count)} of ${formatWhole(of)}`);

interface Row {
  readonly strategy: Strategy;
  readonly results: StrategySummary;
}

const bad = (count: number) => ({ "data-bad": count > 0 || undefined });

function columnsOf(summary: BatchSummary, opening: Opening): readonly Column<Row>[] {
  const damping = { group: "Least damping ratio of the closed loop" };
  return [
    { key: "strategy", head: "Strategy", text: true, cell: ({ strategy }) => <StrategyName strategy={strategy} /> },
    {
      ...damping,
      key: "nominal",
      head: "nominal",
      span: ({ results }) => (results.stability.known === 0 ? 4 : 1),
      cell: ({ results: { stability } }) =>
        stability.known === 0 ? (
          <span className={ui.dim}>not judged: this controller is no linear law</span>
        ) : (
          shown(stability.nominal)
        ),
    },
    {
      ...damping,
      key: "median",
      head: "median",
      cell: ({ results }) => shown(quantile(summary, results.stability, 50)),
    },
    {
      ...damping,
      key: "lowest",
      head: "lowest",
      cell: ({ strategy, results: { stability } }) => (
        <RunButton
          run={stability.lowest}
          text={shown(stability.lowest?.value ?? null)}
          what={`${strategy.label}: least damping`}
          opening={opening}
        />
      ),
    },
    {
      ...damping,
      key: "unstable",
      head: "unstable at",
      attributes: ({ results }) => bad(results.stability.unstable),
      cell: ({ results: { stability } }) => times(stability.unstable, stability.known),
    },
    ...eventColumns(TRAVEL, "Travel over the limit", "mm", opening),
    ...eventColumns(AIRBORNE, "A tyre airborne", "ms", opening),
    {
      key: "failed",
      group: "Runs",
      head: "failed",
      attributes: ({ results }) => bad(results.failed),
      cell: ({ results }) => formatWhole(results.failed),
    },
  ];
}

const shown = (damping: number | null) => (damping === null ? "–" : formatFixed(damping, 2));

function eventColumns(event: string, group: string, unit: string, opening: Opening): readonly Column<Row>[] {
  return [
    {
      key: `${event} at`,
      group,
      head: "at",
      attributes: ({ results }) => bad(results.figures[event]?.above_zero ?? 0),
      cell: ({ results: { figures } }) => (figures[event] ? times(figures[event].above_zero, figures[event].n) : "–"),
    },
    {
      key: `${event} most`,
      group,
      head: "at most",
      cell({ strategy, results: { figures } }) {
        const { above_zero: happens = 0, highest = null } = figures[event] ?? {};
        if (happens === 0 || !highest) return "–";
        return (
          <RunButton
            run={highest}
            text={`${formatResult(highest.value)}\u00a0${unit}`}
            what={`${strategy.label}: ${group.toLowerCase()}`}
            opening={opening}
          />
        );
      },
    },
  ];
}
