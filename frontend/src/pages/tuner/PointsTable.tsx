/** The best points beside the paper's weights: what they give on the training roads, and their weights. */

import { Button, Stack } from "@mantine/core";
import type { ReactNode } from "react";
import type { Tuning } from "../../api/types";
import { ChangeMark } from "../../features/tables/ChangeMark";
import tables from "../../features/tables/tables.module.css";
import { dotted } from "../../scenario/fields";
import { formatResult, prettyUnit } from "../../units/format";
import type { Shown } from "./figures";
import type { Point, TuningParts } from "./points";
import { formatValue, singlesIn, weightAt, type Single, type Tunable } from "./space";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";

/** A row of the table: what it is of, and what stands under each point. */
interface Row {
  readonly label: string;
  readonly unit: string;
  readonly cell: (point: Point) => ReactNode;
  readonly attributes?: (point: Point) => ReturnType<NonNullable<Column<Row>["attributes"]>>;
}

export function PointsTable({ tuning, objectives, limits, tunable, points, load }: Omit<TuningParts, "colour">) {
  const rows = [...objectiveRows(objectives, tuning), ...limitRows(limits, tuning), ...weightRows(tunable, points)];
  return (
    <Card aria-label="Best points" title="Best points, on the training roads">
      <DataTable
        label="Best points and their weights"
        rows={rows}
        rowKey={({ label }) => label}
        columns={[
          {
            key: "quantity",
            head: "",
            text: true,
            cell: ({ label, unit }) => (
              <>
                {label} <span className={ui.dim}>{prettyUnit(unit)}</span>
              </>
            ),
          },
          ...points.map((point): Column<Row> => ({
            key: String(point.trial.number),
            head: <PointHead point={point} load={load} />,
            headAttributes: { "data-trial": point.trial.number },
            attributes: ({ attributes }) => attributes?.(point) ?? {},
            cell: ({ cell }) => cell(point),
          })),
        ]}
      />
    </Card>
  );
}

function PointHead({ point: { trial, names }, load }: { readonly point: Point; readonly load: TuningParts["load"] }) {
  return (
    <Stack gap={3} align="flex-end">
      <b>{names.join(", ")}</b>
      <span className={ui.dim}>trial {trial.number}</span>
      <Button
        size="compact-xs"
        loading={load.opening?.number === trial.number}
        aria-label={`Load in lab: ${names.join(", ")}`}
        onClick={() => load.open(trial)}
      >
        Load in lab
      </Button>
    </Stack>
  );
}

const objectiveRows = (objectives: readonly Shown[], tuning: Tuning) =>
  objectives.map(({ label, unit, scale }, index): Row => ({
    label,
    unit,
    attributes: ({ trial }) => ({ "data-cell": `objectives.${index}`, "data-value": trial.values?.[index] ?? "" }),
    cell: ({ trial, isPaper }) => (
      <>
        <span className={tables.value}>
          {trial.values ? formatResult((trial.values[index] ?? NaN) * scale, 4) : "–"}
        </span>
        {isPaper ? (
          <span className={tables.change}>&nbsp;</span>
        ) : (
          <ChangeMark value={trial.values?.[index]} baseline={tuning.paper?.values?.[index]} />
        )}
      </>
    ),
  }));

const limitRows = (limits: readonly Shown[], tuning: Tuning) =>
  limits.map(({ label, unit, scale }, index): Row => ({
    label: `${label}, largest`,
    unit,
    cell({ trial }) {
      const value = trial.limits?.[index];
      return (
        <LimitValue
          value={value === undefined ? "–" : formatResult(value * scale)}
          over={value !== undefined && value > (tuning.limits[index]?.at_most ?? Infinity)}
        />
      );
    },
  }));

function weightRows(tunable: Tunable, points: readonly Point[]): readonly Row[] {
  return [
    ...tunable.triples.map(({ pointer, title, items }): Row => ({
      label: title,
      unit: items.map((item) => item.title.toLowerCase()).join(" · "),
      attributes: () => ({ "data-weights": dotted(pointer) }),
      cell: ({ trial }) =>
        items.map((item) => shownWeight(weightAt(trial.weights, dotted(item.pointer)), item)).join(" · "),
    })),
    ...singlesIn(tunable, points[0]?.trial.weights ?? {}).map(({ name, title, field }): Row => ({
      label: title,
      unit: "1",
      cell: ({ trial }) => shownWeight(weightAt(trial.weights, name), field),
    })),
  ];
}

const shownWeight = (value: number | string | undefined, field: Single["field"]) =>
  value === undefined ? "–" : formatValue(value, field);

/** A limited figure, and whether it is over its limit. */
export function LimitValue({ value, over }: { readonly value: string; readonly over: boolean }) {
  return (
    <span className={over ? ui.error : undefined}>
      <span className={tables.value}>{value}</span>
      <span className={over ? `${tables.change} ${ui.error}` : tables.change}>
        {over ? "over the limit" : "\u00a0"}
      </span>
    </span>
  );
}
