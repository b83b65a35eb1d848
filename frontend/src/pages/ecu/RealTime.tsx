/** The drive by the clock: how long answers take, how evenly, and how many come too late. */

import { Box, Button, Group, Progress, SegmentedControl, Stack, Text, useComputedColorScheme } from "@mantine/core";
import { useMutation, useQuery } from "@tanstack/react-query";
import { useEffect, useMemo, useRef, useState } from "react";
import { ask } from "../../api/http";
import { isTransient } from "../../api/problem";
import type { RealtimeReport, Scenario } from "../../api/types";
import { Chart } from "../../plots/Chart";
import { ChartButton } from "../../plots/FigureButton";
import { ON_PAPER, PALETTES } from "../../plots/palettes";
import { compilersQuery } from "../../server/queries";
import { useCatalogue, useStrategies } from "../../server/useCatalogues";
import { formatPercent } from "../../features/tables/change";
import { VIEWS } from "../../features/tables/entries";
import { count, formatNumber, formatWhole } from "../../units/format";
import { formatTime } from "./effort";
import { histogramFigure, histogramTable } from "./histogram";
import { DataTable } from "../../ui/DataTable";
import { Fault, Note } from "../../ui/Messages";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";

interface Props {
  readonly scenario: Scenario;
  /** The drive takes so long [s], where it is known. */
  readonly seconds: number | undefined;
  readonly colour: string;
}

export function RealTime({ scenario, seconds, colour }: Props) {
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
          both sides, not a real-time one: the figures are the server’s at that moment, not an ECU’s.
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
      {report && <Report {...{ report, colour }} />}
    </Card>
  );
}

const TICK_MS = 250;

/** Building and starting come before the first frame. */
const BEFORE_S = 1;

function Waiting({ seconds }: { readonly seconds: number | undefined }) {
  const [passed, setPassed] = useState(0);
  useEffect(() => {
    const begin = performance.now();
    const timer = setInterval(() => setPassed((performance.now() - begin) / 1000), TICK_MS);
    return () => clearInterval(timer);
  }, []);
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

interface ReportProps {
  readonly report: RealtimeReport;
  readonly colour: string;
}

function Report({ report, colour }: ReportProps) {
  const catalogue = useCatalogue();
  const strategies = useStrategies();
  const lightColour = strategies.find(({ id }) => id === "lv_hil")?.colour ?? colour;
  const palette = PALETTES[useComputedColorScheme("light")];
  const [kind, setKind] = useState<PlotKind>("latency");
  const label = KINDS.find(({ value }) => value === kind)?.label ?? "";
  const spread = report[kind];
  const host = useRef<HTMLDivElement>(null);
  const figure = useMemo(
    () => (spread ? histogramFigure(spread, report.deadline, { palette, colour }) : null),
    [spread, report.deadline, palette, colour],
  );
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
          {spread && (
            <ChartButton
              title={`Histogram of ${label.toLowerCase()}`}
              file={`ridelab-real-time-${kind}`}
              hostRef={host}
              draw={() => ({
                figure: histogramFigure(spread, report.deadline, {
                  palette: ON_PAPER,
                  colour: lightColour,
                  title: label,
                }),
                legend: [],
                table: histogramTable(spread),
              })}
            />
          )}
        </Group>
        {figure ? (
          <Chart
            hostRef={host}
            figure={figure}
            height={230}
            label={`Histogram of ${kind.replace("_", "-")} over ${report.steps} steps; its figures stand in the table above`}
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
