/** The best points beside the paper's weights: what they give on the training roads, and their weights. */

import { Button, Stack } from "@mantine/core";
import { Fragment, type ReactNode } from "react";
import type { Trial, Tuning, Weights } from "../../api/types";
import { changeAgainst } from "../../features/tables/change";
import { ValueAndChange } from "../../features/tables/ChangeMark";
import tables from "../../features/tables/tables.module.css";
import { dotted } from "../../scenario/fields";
import { formatResult } from "../../units/format";
import {
  type ShownNumber,
  type Point,
  type TuningParts,
  singlesIn,
  formatValue,
  weightAt,
  type Single,
  type Tunable,
} from "./space";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card } from "../../ui/Card";
import { NameWithUnit } from "../../ui/StrategyKey";
import ui from "../../ui/ui.module.css";

/** A row of the table: what it is of, and what stands under each point. */
interface Row {
  readonly label: string;
  readonly unit: string;
  readonly cell: (point: Point) => ReactNode;
  readonly attributes?: (point: Point) => ReturnType<NonNullable<Column<Row>["attributes"]>>;
}

const QUANTITY: Column<Row> = {
  key: "quantity",
  head: "",
  text: true,
  cell: ({ label, unit }) => <NameWithUnit name={label} unit={unit} />,
};

const columnOf = (point: Point, head: ReactNode): Column<Row> => ({
  key: String(point.trial.number),
  head,
  headAttributes: { "data-trial": point.trial.number },
  attributes: ({ attributes }) => attributes?.(point) ?? {},
  cell: ({ cell }) => cell(point),
});

type Parts = Pick<TuningParts, "tuning" | "objectives" | "limits" | "tunable">;

const rowsOf = ({ tuning, objectives, limits, tunable }: Parts, weights: Weights, beside?: Weights) => [
  ...objectiveRows(objectives, tuning),
  ...limitRows(limits, tuning),
  ...weightRows(tunable, weights, beside),
];

export function PointsTable({ points, load, ...parts }: TuningParts) {
  return (
    <Card aria-label="Best points" title="Best points, on the training roads">
      <DataTable
        label="Best points and their weights"
        rows={rowsOf(parts, points[0]?.trial.weights ?? {})}
        rowKey={({ label }) => label}
        columns={[QUANTITY, ...points.map((point) => columnOf(point, <PointHead point={point} load={load} />))]}
      />
    </Card>
  );
}

/** One of the trials; in small the paper's weights beside each that differs. */
export function PointTable({ trial, ...parts }: Parts & { readonly trial: Trial }) {
  const { paper } = parts.tuning;
  return (
    <DataTable
      label="Values of the selected point"
      attributes={{ "data-dense": true }}
      rows={rowsOf(parts, trial.weights, paper?.weights)}
      rowKey={({ label }) => label}
      columns={[QUANTITY, columnOf({ trial, names: [], isPaper: trial.number === paper?.number }, "Value")]}
    />
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

const objectiveRows = (objectives: readonly ShownNumber[], tuning: Tuning) =>
  objectives.map(({ label, unit, scale }, index): Row => ({
    label,
    unit,
    attributes: ({ trial }) => ({ "data-cell": `objectives.${index}`, "data-value": trial.values?.[index] ?? "" }),
    cell: ({ trial, isPaper }) => (
      <ValueAndChange
        text={trial.values ? formatResult((trial.values[index] ?? NaN) * scale, 4) : "–"}
        change={isPaper ? null : changeAgainst(trial.values?.[index], tuning.paper?.values?.[index])}
      />
    ),
  }));

const limitRows = (limits: readonly ShownNumber[], tuning: Tuning) =>
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

interface WeightValuesProps {
  readonly fields: readonly Pick<Single, "name" | "field">[];
  readonly weights: Weights;
  readonly beside: Weights | undefined;
}

/** Values of a row in one line, under it in small those they are beside, struck through where they differ. */
function WeightValues({ fields, weights, beside }: WeightValuesProps) {
  const shown = fields.map(({ name, field }) => {
    const own = weightAt(weights, name);
    const other = (beside && weightAt(beside, name)) ?? own;
    return { name, own: shownWeight(own, field), other: shownWeight(other, field) };
  });
  return (
    <>
      {shown.map(({ own }) => own).join(" · ")}
      {shown.some(({ own, other }) => other !== own) && (
        <span className={ui.under}>
          {shown.map(({ name, own, other }, index) => (
            <Fragment key={name}>
              {index > 0 && " · "}
              {other === own ? other : <s>{other}</s>}
            </Fragment>
          ))}
        </span>
      )}
    </>
  );
}

function weightRows(tunable: Tunable, weights: Weights, beside?: Weights): readonly Row[] {
  const row = (name: string, label: string, unit: string, fields: readonly Pick<Single, "name" | "field">[]): Row => ({
    label,
    unit,
    attributes: () => ({ "data-weights": name }),
    cell: ({ trial }) => <WeightValues {...{ fields, beside }} weights={trial.weights} />,
  });
  return [
    ...tunable.triples.map(({ pointer, title, items }) =>
      row(
        dotted(pointer),
        title,
        items.map((item) => item.title.toLowerCase()).join(" · "),
        items.map((field) => ({ name: dotted(field.pointer), field })),
      ),
    ),
    ...singlesIn(tunable, weights).map((single) => row(single.name, single.title, "1", [single])),
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
