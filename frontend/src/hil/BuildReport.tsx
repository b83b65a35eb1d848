/** Whether the controller fits the microcontroller: memory and time of the scenario's own and of smaller ones, with what each loses. */

import { Button, Skeleton, Switch, Text } from "@mantine/core";
import { IconAlertTriangle, IconCheck } from "../icons";
import { queryOptions, useQuery } from "@tanstack/react-query";
import { useState } from "react";
import { api } from "../api/client";
import type { Catalogue, ControllerReport, Scenario } from "../api/types";
import { formatPercent } from "../tables/change";
import { headingOf, VIEWS } from "../tables/ComparisonTable";
import { formatNumber, formatWhole } from "../units/format";
import { formatEnds, formatTime, kilobytes, largestLoss } from "./effort";
import classes from "./hil.module.css";
import { ScrollTable } from "../ui/ScrollTable";
import { Fault } from "../ui/Fault";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

interface Props {
  readonly scenario: Scenario;
  readonly catalogue: Catalogue;
}

const reportQuery = (scenario: Scenario, enabled: boolean) =>
  queryOptions({ queryKey: ["controller report", scenario], queryFn: ({ signal }) => api.controllerReport(scenario, signal), staleTime: Infinity, enabled });

export function BuildReport({ scenario, catalogue }: Props) {
  const [requested, setRequested] = useState<Scenario | null>(null);
  const report = useQuery(reportQuery(scenario, requested === scenario));
  return (
    <Card
      aria-label="Build report"
      aria-busy={report.isFetching || undefined}
      title="Does it fit a small microcontroller?"
      tools={
        <>
          {!report.data && (
            <Button size="xs" variant="default" loading={report.isFetching} onClick={() => (requested === scenario ? void report.refetch() : setRequested(scenario))}>
              Build and measure
            </Button>
          )}
        </>
      }
    >
      {report.data ? (
        <Report report={report.data} catalogue={catalogue} />
      ) : (
        <div className={classes.body}>
          <Text size="sm" c="dimmed">
            {report.isFetching
              ? "The program is built for the part and driven over the road, the scenario’s own and smaller ones: this takes some seconds each."
              : "Compiles the controller for a Cortex-M3 at 72 MHz without floating-point hardware (64 KB RAM, 512 KB flash), counts what a step costs, and does the same with shorter horizons."}
          </Text>
          {report.isFetching && <Skeleton height={180} radius={6} />}
          {report.isError && !report.isFetching && (
            <Fault>{report.error.message}</Fault>
          )}
        </div>
      )}
    </Card>
  );
}

function Report({ report, catalogue }: { readonly report: ControllerReport; readonly catalogue: Catalogue }) {
  const { part, rows, sample_time: step, cycles_per_operation: cycles, spread } = report;
  const [all, setAll] = useState(false);
  const [own, ...smaller] = rows;
  const fitting = smaller.filter(({ fits }) => fits);
  const least = fitting.toSorted((a, b) => largestLoss(a.changes) - largestLoss(b.changes))[0];
  return (
    <>
      <Text size="sm" className={classes.body ?? ""} data-testid="fits">
        {own?.fits
          ? "The scenario’s own controller fits. "
          : `The scenario’s own controller does not fit: ${own?.reasons.join("; ") ?? ""}. `}
        {!own?.fits &&
          (least
            ? `Of the smaller ones ${fitting.length === 1 ? "one fits" : `${fitting.length} fit`}; the least loss has Np ${least.prediction_horizon}, Nc ${least.control_horizon}, ${least.checked_rows} limits checked.`
            : "None of the smaller ones tried does either.")}
      </Text>
      <ScrollTable label="Controllers on the part" className={classes.report}>
        <thead>
          <tr>
            <th scope="col" data-left>
              Np · Nc
            </th>
            <th scope="col">Limits checked</th>
            <th scope="col">Iterations</th>
            <th scope="col">
              Flash <span className={ui.dim}>of {kilobytes(part.flash)}</span>
            </th>
            <th scope="col">
              RAM with stack <span className={ui.dim}>of {kilobytes(part.ram)}</span>
            </th>
            <th scope="col">
              Operations a step <span className={ui.dim}>least to most</span>
            </th>
            <th scope="col">
              Time a step <span className={ui.dim}>of {formatTime(step)}</span>
            </th>
            <th scope="col">Fits</th>
            {VIEWS.map((view) =>
              all ? (
                catalogue.paper_signals.map((signal) => (
                  <th key={`${view.window} ${signal}`} scope="col">
                    {labelOf(signal, catalogue)} <span className={ui.dim}>{headingOf(view, catalogue)}</span>
                  </th>
                ))
              ) : (
                <th key={view.window} scope="col">
                  {headingOf(view, catalogue)} <span className={ui.dim}>largest increase</span>
                </th>
              ),
            )}
          </tr>
        </thead>
        <tbody>
          {rows.map((row, index) => (
            <tr key={`${row.prediction_horizon} ${row.control_horizon} ${row.checked} ${row.iterations}`} data-fits={row.fits}>
              <th scope="row" data-left>
                {row.prediction_horizon} · {row.control_horizon}
                {index === 0 && <span className={ui.dim}> the scenario’s</span>}
              </th>
              <td>{formatWhole(row.checked_rows)}</td>
              <td>
                {formatWhole(row.most_iterations)} of {formatWhole(row.iterations)}
                {row.unfinished > 0 && <span className={classes.bad}>, {formatWhole(row.unfinished)} unfinished</span>}
              </td>
              <td>{kilobytes(row.code + row.constants)}</td>
              <td>{kilobytes(row.variables + part.stack)}</td>
              <td>
                {formatEnds(row.operations, formatWhole)}
              </td>
              <td>
                {formatEnds(row.time, formatTime)}
              </td>
              <td>
                <Fits fits={row.fits} reasons={row.reasons} />
              </td>
              {VIEWS.map(({ window }) =>
                all ? (
                  catalogue.paper_signals.map((signal) => <td key={`${window} ${signal}`}>{shownChange(row.changes[window]?.[signal])}</td>)
                ) : (
                  <td key={window}>
                    <Loss changes={row.changes[window] ?? {}} catalogue={catalogue} />
                  </td>
                ),
              )}
            </tr>
          ))}
        </tbody>
      </ScrollTable>
      <Switch size="xs" className={classes.all ?? ""} label="All eight figures" checked={all} onChange={(event) => setAll(event.currentTarget.checked)} />
      <Text size="xs" c="dimmed" className={classes.foot ?? ""}>
        The last columns: the change to LV in the simulation. Where fewer limits are checked than in the scenario’s own, they are the first move’s forces and every third deflection of the horizon.{" "}
        {part.name}. Memory from the linked program, {formatWhole(part.stack)} bytes of stack. The program counts its own multiplications with addition; one costs {formatNumber(cycles)} cycles there
        (±{formatNumber(100 * spread, 2)}&nbsp;%), measured in an emulator that counts cycles as the processor’s manual does.
      </Text>
    </>
  );
}

const labelOf = (signal: string, catalogue: Catalogue) => catalogue.signals.find(({ key }) => key === signal)?.label ?? signal;

const shownChange = (change: number | null | undefined) => (typeof change === "number" ? formatPercent(change) : "–");

function Fits({ fits, reasons }: { readonly fits: boolean; readonly reasons: readonly string[] }) {
  const Icon = fits ? IconCheck : IconAlertTriangle;
  return (
    <span className={fits ? classes.good : classes.bad} title={reasons.join("\n")}>
      <Icon size={14} stroke={2} aria-hidden className={classes.icon} /> {fits ? "yes" : "no"}
      {!fits && <span className="visually-hidden">: {reasons.join("; ")}</span>}
    </span>
  );
}

/** The largest increase, and of what. */
function Loss({ changes, catalogue }: { readonly changes: Readonly<Record<string, number | null>>; readonly catalogue: Catalogue }) {
  const changed = Object.entries(changes).flatMap(([signal, change]) => (change === null ? [] : [{ signal, change }]));
  const worst = changed.toSorted((a, b) => b.change - a.change)[0];
  if (!worst) return <>–</>;
  return (
    <>
      {formatPercent(worst.change)} <span className={classes.lossOf}>{labelOf(worst.signal, catalogue)}</span>
    </>
  );
}
