/** Comfort, travel time and events: a row per figure, a column per strategy. */

import type { ReactNode } from "react";
import type { Catalogue, Quantity } from "../../api/types";
import { useCatalogue } from "../../server/useCatalogues";
import type { ResultView } from "../../lab/resultView";
import { formatNumber, formatResult, prettyUnit } from "../../units/format";
import { ChangeText, Estimated } from "./ChangeMark";
import { changeOf, entryGroups, type Entry, CURRENT, type EntryGroup, intervalAt } from "./entries";
import { metricName, valueAt, type MetricPath } from "../../lab/metricPath";
import { StrategyName } from "../../ui/StrategyKey";
import classes from "./tables.module.css";
import { DataTable, type Column } from "../../ui/DataTable";
import { ManualLink } from "../../ui/ManualLink";
import ui from "../../ui/ui.module.css";
import { requiredOf } from "../requirements/judged";
import { RequirementMarks } from "../requirements/RequirementsCard";

type Value = number | boolean | null | undefined;

interface Row {
  readonly quantity: Quantity;
  /** Where its number stands; an event has none. */
  readonly metric: MetricPath | null;
  /** Lower is better, so that a change has a verdict. */
  readonly judged: boolean;
}

function rows(catalogue: Catalogue): readonly Row[] {
  return [
    ...catalogue.comfort.map((quantity) => ({ quantity, metric: { comfort: quantity.key }, judged: true })),
    ...catalogue.run_figures.map((quantity) => ({
      quantity,
      metric: { run: quantity.key },
      judged: quantity.key === "travel_time",
    })),
    ...catalogue.events.map((quantity) => ({ quantity, metric: null, judged: false })),
  ];
}

function show(value: Value): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value !== "number") return "–";
  return Number.isInteger(value)
    ? formatNumber(value, Math.max(1, String(Math.abs(value)).length))
    : formatResult(value);
}

export function RunTable({ resultView }: { readonly resultView: ResultView }) {
  return (
    <DataTable
      label="Comfort, time and events"
      rows={rows(useCatalogue())}
      rowKey={({ quantity }) => quantity.key}
      columns={[
        {
          key: "quantity",
          head: "Comfort, time and events",
          text: true,
          attributes: ({ quantity }) => ({ title: quantity.description }),
          cell: ({ quantity }) => (
            <>
              {quantity.label} <span className={ui.dim}>{prettyUnit(quantity.unit)}</span>{" "}
              <ManualLink name={quantity.key} label={quantity.label} text={quantity.description} />
            </>
          ),
        },
        ...variantColumns<Row>(
          entryGroups(resultView),
          ({ strategy }) => <StrategyName strategy={strategy} />,
          (entry) => ({
            attributes: ({ quantity }) => ({ "data-cell": `${entry.strategy.id}.${quantity.key}` }),
            cell: (row) => <RunCell {...{ resultView, entry, row }} />,
          }),
        ),
      ]}
    />
  );
}

interface RunCellProps {
  readonly resultView: ResultView;
  readonly entry: Entry;
  readonly row: Row;
}

function RunCell({ resultView, entry, row: { quantity, metric, judged } }: RunCellProps) {
  const interval = metric ? intervalAt(entry.shown, entry.strategy.id, metric) : undefined;
  const value = metric ? valueAt(entry.summary, metric) : entry.summary?.events[quantity.key];
  return (
    <>
      {interval ? (
        <Estimated value={interval.mean} interval={interval} scale={1} />
      ) : (
        <span className={classes.value}>{show(value)}</span>
      )}
      {judged && metric && !entry.isBaseline && <ChangeText change={changeOf(resultView, entry, metric)} />}
      <RequirementMarks
        results={requiredOf(resultView.judged, entry, metric ? metricName(metric) : `events.${quantity.key}`)}
      />
    </>
  );
}

type Parts<Row> = Omit<Column<Row>, "key" | "group" | "head" | "text">;

/** A column for each strategy of each variant, under the variants' names where there are several. */
export function variantColumns<Row>(
  groups: readonly EntryGroup[],
  headOf: (entry: Entry) => ReactNode,
  partsOf: (entry: Entry) => Parts<Row>,
): readonly Column<Row>[] {
  return groups.flatMap(({ name, entries }) => {
    // Each an element of its own: variants of the same name stay two.
    const group = groups.length > 1 ? <>{name ?? CURRENT}</> : undefined;
    return entries.map((entry) => ({ ...partsOf(entry), key: entry.key, group, head: headOf(entry) }));
  });
}
