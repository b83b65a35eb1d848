/** The drive by the clock: how long answers take, how evenly, and how many come too late. */

import { Box, Button, Group, Progress, SegmentedControl, Stack, Text } from "@mantine/core";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useMemo, useState } from "react";
import { ask } from "../../api/http";
import { isTransient } from "../../api/problem";
import type { RealtimeReport, Scenario, Times } from "../../api/types";
import { Chart, type ChartFigure } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { chartLayout, referenceLine } from "../../plots/palettes";
import { compilersQuery } from "../../server/queries";
import { useCatalogue } from "../../server/useCatalogues";
import { formatPercent } from "../../features/tables/change";
import { VIEWS } from "../../features/tables/entries";
import { count, formatNumber, formatWhole } from "../../units/format";
import { formatTime } from "./BuildReport";
import { useElapsed } from "../../lib/useElapsed";
import { DataTable } from "../../ui/DataTable";
import { Fault, Note } from "../../ui/Messages";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly scenario: Scenario;
  /** The drive takes so long [s], where it is known. */
  readonly seconds: number | undefined;
}

export function RealTime({ scenario, seconds }: Props) {
  const drive = useMutation({
    mutationFn: (wanted: Scenario) => ask("post", "/controller/realtime", { body: { scenario: wanted } }),
  });
  const report = drive.data;
  const missing = useQuery(compilersQuery).data?.realtime ?? null;
  const other = drive.isSuccess && drive.variables !== scenario;
  return (
    <Card
      aria-label="In real time"
      aria-busy={drive.isPending || undefined}
      title="In real time"
      tools={
        <Button loading={drive.isPending} disabled={missing !== null} onClick={() => drive.mutate(scenario)}>
          {report ? "Drive again" : "Drive in real time"}
        </Button>
      }
    >
      <Stack gap="xs" px="0.9rem" pb="sm">
        <Text c="dimmed">
          The same program, a frame every control step by the clock; an answer after the next frame’s time is a missed
          deadline, and the actuators hold the last command. It takes as long as the drive
          {seconds === undefined ? "" : `, about ${formatNumber(seconds, 2)} s`}. An ordinary operating system wakes
          both sides, not a real-time one: the times are the server’s at that moment, not an ECU’s.
        </Text>
        {missing !== null && <Fault>{missing}.</Fault>}
        {drive.isPending && <Waiting seconds={seconds} />}
        {drive.isError && (
          <Fault>
            {isTransient(drive.error)
              ? `The server has no room for a drive by the clock just now: ${drive.error.message}`
              : drive.error.message}
          </Fault>
        )}
        {other && (
          <Text size="xs" className={ui.warning ?? ""} role="status">
            The scenario has changed since: these numbers are of the previous one.
          </Text>
        )}
      </Stack>
      {report && <Report report={report} />}
    </Card>
  );
}

const TICK_MS = 250;

/** Building and starting come before the first frame. */
const BEFORE_S = 1;

function Waiting({ seconds }: { readonly seconds: number | undefined }) {
  const passed = useElapsed(TICK_MS);
  const whole = seconds === undefined ? undefined : seconds + BEFORE_S;
  return (
    <Stack gap={5}>
      <Progress.Root size={8} transitionDuration={TICK_MS}>
        <Progress.Section
          value={whole === undefined ? 100 : Math.min(99, (100 * passed) / whole)}
          animated={whole === undefined || passed > whole}
          color="var(--accent)"
          aria-label="Driven"
        />
      </Progress.Root>
      <Note>
        {formatWhole(Math.round(passed))}
        {whole === undefined ? " s" : ` of about ${formatWhole(Math.round(whole))} s`}
      </Note>
    </Stack>
  );
}

const KINDS = [
  { value: "latency", label: "Latency" },
  { value: "wake_up", label: "Wake-up" },
  { value: "computing", label: "Computing" },
] as const;
type PlotKind = (typeof KINDS)[number]["value"];

const TIMES = [
  ["mean", "Mean"],
  ["deviation", "Deviation"],
  ["median", "Median"],
  ["percentile_99", "99 %"],
  ["most", "Most"],
] as const;

const shownTime = (time: number | undefined) => (time === undefined ? "–" : formatTime(time));

const MEANING: Readonly<Record<PlotKind, string>> = {
  latency: "From a frame’s sending to its answer.",
  wake_up: "How late the frame itself was sent: the operating system’s jitter.",
  computing: "What the program itself took, by its own clock.",
};

function Report({ report }: { readonly report: RealtimeReport }) {
  const catalogue = useCatalogue();
  const [kind, setKind] = useState<PlotKind>("latency");
  const label = KINDS.find(({ value }) => value === kind)?.label ?? "";
  const { [kind]: spread, deadline } = report;
  const { chart, button } = useChart({
    title: `Histogram of ${label.toLowerCase()}`,
    file: `ridelab-real-time-${kind}`,
    draw: useMemo(
      () =>
        spread &&
        ((look: Look) => ({
          figure: histogramFigure(spread, deadline, look, label),
          legend: [],
          table: histogramTable(spread),
        })),
      [spread, deadline, label],
    ),
  });
  return (
    <>
      <DataTable
        label="Times by the clock"
        rows={KINDS}
        rowKey={({ value }) => value}
        columns={[
          {
            key: "kind",
            head: (
              <span className={report.misses === 0 ? ui.good : ui.warning} data-testid="misses">
                {report.misses === 0 ? "No deadline missed" : `${count(report.misses, "deadline")} missed`} in{" "}
                {count(report.steps, "step")}
              </span>
            ),
            text: true,
            cell: ({ value, label }) => (
              <>
                {label} <span className={ui.dim}>{MEANING[value]}</span>
              </>
            ),
          },
          ...TIMES.map(([key, head]) => ({
            key,
            head,
            cell: ({ value }: (typeof KINDS)[number]) => shownTime(report[value]?.[key]),
          })),
        ]}
      />
      <Box px="0.9rem" pt="xs">
        <Group gap="xs">
          <SegmentedControl aria-label="Histogram of" value={kind} data={[...KINDS]} onChange={setKind} />
          {button}
        </Group>
        {spread ? (
          <Chart
            {...chart}
            height={230}
            label={`Histogram of ${kind.replace("_", "-")} over ${report.steps} steps; its times stand in the table above`}
          />
        ) : (
          <Text c="dimmed">There is nothing to count: no answer came in time.</Text>
        )}
      </Box>
      <Text px="0.9rem" pt={6} pb="sm">
        <span className={ui.dim}>Against the drive in lock-step: </span>
        {VIEWS.map(({ window, statistic }) => (
          <span key={window}>
            {statistic === "rms" ? "RMS" : "peaks"}{" "}
            {catalogue.paper_signals
              .map((signal) => report.changes[window]?.[signal] ?? null)
              .map((change) => (change === null ? "–" : formatPercent(change)))
              .join(", ")}
            {". "}
          </span>
        ))}
      </Text>
    </>
  );
}

const TICKS = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];

export function histogramFigure(
  { edges, counts }: Times,
  deadline: number,
  { palette, strategies, onPaper }: Look,
  title: string,
): ChartFigure {
  const color = strategies.find(({ id }) => id === "lv_hil")?.colour;
  const logs = edges.map(Math.log10);
  const bin = (index: number) => [logs[index] ?? 0, logs[index + 1] ?? 0] as const;
  const [low, high] = [logs[0] ?? -6, logs.at(-1) ?? -1];
  const at = Math.log10(deadline);
  return {
    data: [
      {
        type: "bar",
        name: "Steps",
        // Drawn over the logarithm, as plotly's bars have no width of their own on a logarithmic axis.
        x: counts.map((_, index) => (bin(index)[0] + bin(index)[1]) / 2),
        y: counts,
        width: counts.map((_, index) => 0.94 * (bin(index)[1] - bin(index)[0])),
        marker: { color },
        text: counts.map(
          (number, index) =>
            `${formatTime(edges[index] ?? 0)} to ${formatTime(edges[index + 1] ?? 0)}: ${formatWhole(number)}`,
        ),
        textposition: "none",
        hovertemplate: "%{text}<extra></extra>",
      },
    ],
    layout: chartLayout(palette, {
      margin: { l: 52, r: 12, t: 18, b: 36 },
      dragmode: false,
      xaxis: {
        ...(onPaper && { title: { text: title } }), // on the page the switch above says it
        range: [low, high],
        tickvals: TICKS.map(Math.log10),
        ticktext: TICKS.map(formatTime),
        fixedrange: true,
      },
      yaxis: { title: { text: "Steps" }, rangemode: "tozero", fixedrange: true },
      ...referenceLine(palette, "x", at, "deadline", "center"),
    }),
  };
}

const histogramTable = ({ edges, counts }: Times) => [
  ["from [s]", "to [s]", "steps"],
  ...counts.map((number, index) => [edges[index], edges[index + 1], number]),
];
