/** Whether the controller fits the microcontroller: memory and time of the scenario's own and of smaller ones, with what each loses. */

import { Button, Skeleton, Stack, Switch, Text } from "@mantine/core";
import { Icon } from "../../ui/icons";
import { queryOptions, useQuery } from "@tanstack/react-query";
import { useState, type ReactNode } from "react";
import { ask } from "../../api/http";
import type { ControllerReport, Scenario } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import { VIEWS } from "../../features/tables/entries";
import { formatNumber, formatWhole, formatInput } from "../../units/format";
import { DataTable, type Column } from "../../ui/DataTable";
import { Fault, Note } from "../../ui/Messages";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { useLabels, type Labels } from "../../server/useCatalogues";

const reportQuery = (scenario: Scenario, enabled: boolean) =>
  queryOptions({
    queryKey: ["controller report", scenario],
    queryFn: ({ signal }) => ask("post", "/controller/report", { body: { scenario } }, signal),
    staleTime: Infinity,
    enabled,
  });

export function BuildReport({ scenario }: { readonly scenario: Scenario }) {
  const [requested, setRequested] = useState<Scenario | null>(null);
  const report = useQuery(reportQuery(scenario, requested === scenario));
  return (
    <Card
      aria-label="Build report"
      aria-busy={report.isFetching || undefined}
      title="Does it fit a small microcontroller?"
      tools={
        !report.data && (
          <Button
            loading={report.isFetching}
            onClick={() => (requested === scenario ? void report.refetch() : setRequested(scenario))}
          >
            Measure
          </Button>
        )
      }
    >
      {report.data ? (
        <Report report={report.data} />
      ) : (
        <Stack gap="xs" px="0.9rem" pb="sm">
          <Text c="dimmed">
            {report.isFetching
              ? "The program is driven over the road, the scenario’s own and smaller ones: this takes some seconds."
              : "What the controller takes of a Cortex-M3 at 72 MHz without floating-point hardware (64 KB RAM, 512 KB flash): its memory, and the time of a step by the operations that it counts on this road. The same with shorter horizons."}
          </Text>
          {report.isFetching && <Skeleton height={180} radius={6} />}
          {report.isError && !report.isFetching && <Fault>{report.error.message}</Fault>}
        </Stack>
      )}
    </Card>
  );
}

function Report({ report }: { readonly report: ControllerReport }) {
  const words = useLabels();
  const { part, rows, cycles_per_operation: cycles, spread } = report;
  const [all, setAll] = useState(false);
  const [own, ...smaller] = rows;
  const fitting = smaller.filter(({ fits }) => fits);
  const least = fitting.toSorted((a, b) => largestLoss(a.changes) - largestLoss(b.changes))[0];
  return (
    <>
      <Text px="0.9rem" pb="sm" data-testid="fits">
        {own?.fits
          ? "The scenario’s own controller fits. "
          : `The scenario’s own controller does not fit: ${own?.reasons.join("; ") ?? ""}. `}
        {!own?.fits &&
          (least
            ? `Of the smaller ones ${fitting.length === 1 ? "one fits" : `${fitting.length} fit`}; the least loss has Np ${least.prediction_horizon}, Nc ${least.control_horizon}, ${least.checked_rows} limits checked.`
            : "None of the smaller ones tried does either.")}
      </Text>
      <DataTable
        label="Controllers on the part"
        rows={rows}
        rowKey={(row) => `${row.prediction_horizon} ${row.control_horizon} ${row.checked} ${row.iterations}`}
        rowAttributes={({ fits }) => ({ "data-fits": fits })}
        columns={[...costColumns(report), ...(all ? changeColumns(words) : lossColumns(words))]}
      />
      <Switch
        size="xs"
        mx="0.9rem"
        my="xs"
        label="All eight metrics"
        checked={all}
        onChange={(event) => setAll(event.currentTarget.checked)}
      />
      <Note className={ui.note ?? ""}>
        The last columns: the change to LV in the simulation. Where fewer limits are checked than in the scenario’s own,
        they are the first move’s forces and every third deflection of the horizon. {part.name}. Memory from the linked
        program, {formatWhole(part.stack)} bytes of stack. The program counts its own multiplications with addition; one
        costs {formatNumber(cycles)} cycles there (±{formatNumber(100 * spread, 2)}&nbsp;%), measured in an emulator
        that counts cycles as the processor’s manual does.
      </Note>
    </>
  );
}

type Row = ControllerReport["rows"][number];

const column = (key: string, head: string, cell: Column<Row>["cell"], detail = ""): Column<Row> => ({
  key,
  head,
  cell,
  detail,
});

const costColumns = ({ part, rows, sample_time: step }: ControllerReport): readonly Column<Row>[] => [
  {
    key: "horizons",
    head: "Np · Nc",
    text: true,
    cell: (row) => (
      <>
        {row.prediction_horizon} · {row.control_horizon}
        {row === rows[0] && <span className={ui.dim}> the scenario’s</span>}
      </>
    ),
  },
  column("limits", "Limits checked", (row) => formatWhole(row.checked_rows)),
  column("iterations", "Iterations", (row) => (
    <>
      {formatWhole(row.most_iterations)} of {formatWhole(row.iterations)}
      {row.unfinished > 0 && <span className={ui.warning}>, {formatWhole(row.unfinished)} unfinished</span>}
    </>
  )),
  column("flash", "Flash", (row) => kilobytes(row.code + row.constants), `of ${kilobytes(part.flash)}`),
  column("ram", "RAM with stack", (row) => kilobytes(row.variables + part.stack), `of ${kilobytes(part.ram)}`),
  column("operations", "Operations a step", (row) => formatEnds(row.operations, formatWhole), "least to most"),
  column("time", "Time a step", (row) => formatEnds(row.time, formatTime), `of ${formatTime(step)}`),
  column("fits", "Fits", ({ fits, reasons }) => (
    <Judged good={fits} title={reasons.join("\n")}>
      {fits ? "yes" : "no"}
      {!fits && <span className="visually-hidden">: {reasons.join("; ")}</span>}
    </Judged>
  )),
];

const changeColumns = (words: Labels) =>
  VIEWS.flatMap((view) =>
    words.catalogue.paper_signals.map((signal): Column<Row> => ({
      key: `${view.window} ${signal}`,
      group: words.view(view),
      head: words.signal(signal),
      cell: ({ changes }) => shownChange(changes[view.window]?.[signal]),
    })),
  );

const lossColumns = (words: Labels) =>
  VIEWS.map((view): Column<Row> => ({
    key: view.window,
    head: words.view(view),
    detail: "largest increase",
    cell: ({ changes }) => <Loss changes={changes[view.window] ?? {}} words={words} />,
  }));

const shownChange = (change: number | null | undefined) => (typeof change === "number" ? formatPercent(change) : "–");

interface JudgedProps {
  readonly good: boolean;
  readonly title?: string;
  readonly children: ReactNode;
}

/** A sign and a word, which the colour repeats. */
export const Judged = ({ good, title, children }: JudgedProps) => (
  <span className={good ? ui.good : ui.warning} title={title}>
    <Icon name={good ? "Check" : "AlertTriangle"} size={14} className={ui.inline} /> {children}
  </span>
);

interface LossProps {
  readonly changes: Readonly<Record<string, number | null>>;
  readonly words: Labels;
}

/** The largest increase, and of what. */
function Loss({ changes, words }: LossProps) {
  const changed = Object.entries(changes).flatMap(([signal, change]) => (change === null ? [] : [{ signal, change }]));
  const worst = changed.toSorted((a, b) => b.change - a.change)[0];
  if (!worst) return <>–</>;
  return (
    <>
      {formatPercent(worst.change)} <span className={ui.under}>{words.signal(worst.signal)}</span>
    </>
  );
}

const short = (value: number) => formatInput(Number(value.toPrecision(3)));

export const kilobytes = (bytes: number): string => `${short(bytes / 1024)}\u00a0KB`;

/** `8.24 ms`, `140 µs`, `1.2 s`. */
export function formatTime(seconds: number): string {
  if (seconds < 1e-3) return `${short(seconds * 1e6)}\u00a0µs`;
  return seconds < 1 ? `${short(seconds * 1e3)}\u00a0ms` : `${short(seconds)}\u00a0s`;
}

/** `2.4 – 3.1`, and once where both ends read the same. */
export function formatEnds(
  { least, most }: { readonly least: number; readonly most: number },
  format: (value: number) => string,
): string {
  const [low, high] = [format(least), format(most)];
  return low === high ? low : `${low} – ${high}`;
}

type Changes = Readonly<Record<string, Readonly<Record<string, number | null>>>>;

/** The largest increase [%], over all figures. */
export const largestLoss = (changes: Changes): number =>
  Math.max(...Object.values(changes).flatMap((window) => Object.values(window).filter((change) => change !== null)));
