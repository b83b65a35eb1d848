/** The comparison, and on demand everything else the run says in numbers. */

import { Button, Box, Checkbox } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useId, useState, type ReactNode } from "react";
import { Icon } from "../../ui/icons";
import { CompareBar } from "../compare/CompareBar";
import type { SignalKey, Catalogue, Quantity } from "../../api/types";
import { Solve } from "../solve/SolveButton";
import type { ResultView } from "../../lab/resultView";
import {
  ComparisonTable,
  UnitAndTools,
  type ComparisonProps,
  cellAttributes,
  ResultCell,
  EntryHead,
} from "./ComparisonTable";
import classes from "./tables.module.css";
import { Card } from "../../ui/Card";
import { getAt } from "../../scenario/path";
import { whyNotCompared } from "../../lab/compare";
import { DataTable, type Column } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";
import {
  entryGroups,
  showValue,
  isRandom,
  lowestOf,
  VIEWS,
  type WindowView,
  changeOf,
  type Entry,
  CURRENT,
  type EntryGroup,
  intervalAt,
} from "./entries";
import { useLabels, useCatalogue } from "../../server/useCatalogues";
import { prettyUnit } from "../../units/format";
import { ChangeText, Estimated } from "./ChangeMark";
import { metricName, valueAt, type MetricPath } from "../../lab/metricPath";
import { StrategyName } from "../../ui/StrategyKey";
import { ManualLink } from "../../ui/ManualLink";
import { RequirementMarks } from "../requirements/RequirementsCard";
import { requiredOf } from "../requirements/judged";

/** Windows too narrow, beside the form, for both halves of the comparison side by side; paper has no form. */
const NARROW = "screen and (max-width: 67.99em)";

export function Tables({ resultView }: { readonly resultView: ResultView }) {
  const words = useLabels();
  const { catalogue } = words;
  const [more, setMore] = useState(false);
  const id = useId();
  const others = catalogue.metric_signals.filter((signal) => !catalogue.paper_signals.includes(signal));
  const narrow = useMediaQuery(NARROW, false, { getInitialValueInEffect: false });
  const [grouping, setGrouping] = useState<ComparisonProps["grouping"]>("variant");
  const hasIntervals = [resultView, ...resultView.pins].some(({ shown }) => shown.over !== null);
  const compare = (signals: readonly SignalKey[], caption: string, of = "") =>
    narrow ? (
      VIEWS.map((view) => (
        <NarrowTable
          key={view.window}
          {...{ resultView, words, signals, view, grouping }}
          heading={`${words.view(view)}${of}`}
        />
      ))
    ) : (
      <ComparisonTable {...{ resultView, words, signals, caption, grouping }} />
    );
  return (
    <Card className={classes.comparison ?? ""} aria-label="Comparison" data-intervals={hasIntervals || undefined}>
      <CompareBar resultView={resultView} />
      <Solve />
      {!narrow && resultView.pins.length > 0 && (
        <Checkbox
          size="xs"
          m="0.4rem 0.9rem"
          wrapperProps={{ "data-unprinted": true }}
          label="Group by strategy"
          checked={grouping === "strategy"}
          onChange={({ currentTarget: { checked } }) => setGrouping(checked ? "strategy" : "variant")}
        />
      )}
      {compare(catalogue.paper_signals, "RMS on the rough road and peak on the bump")}
      {more && (
        <div id={id}>
          {compare(others, "Suspension travel and actuator forces", ": travel and forces")}
          <RunTable resultView={resultView} />
        </div>
      )}
      <ChangesNote resultView={resultView} />
      <Button
        data-unprinted
        m="0.15rem 0.4rem 0.3rem"
        size="compact-xs"
        variant="subtle"
        aria-expanded={more}
        {...(more ? { "aria-controls": id } : {})}
        rightSection={more ? <Icon name="ChevronUp" size={14} /> : <Icon name="ChevronDown" size={14} />}
        onClick={() => setMore(!more)}
      >
        {more ? "Less" : "Travel, forces, comfort, time and events"}
      </Button>
    </Card>
  );
}

function textOf({ shown, reference }: ResultView): string {
  const { over, scenario } = shown;
  const isMeasured = typeof getAt(scenario, "/road/profile") === "string"; // then there is no other road like it
  if (over === null && !isRandom(scenario)) return "A change without an arrow is zero.";
  if (over === null)
    return `One road: a change without an arrow is zero or not beyond the random variation of one road${isMeasured ? "" : "; choose several roads"}.`;
  const isPaired = reference === null || whyNotCompared(shown, reference.shown) === null;
  return isPaired
    ? "Changes are paired by road, with their 95 % interval; one whose interval includes zero or whose values show the same digits has no arrow."
    : "\u00a0";
}

/** What a change without an arrow says. */
function ChangesNote({ resultView }: { readonly resultView: ResultView }) {
  return (
    <Box component="p" m={0} p="0.3rem 0.9rem 0" fz="xs" c="dimmed" data-testid="changes-note">
      {textOf(resultView)}
    </Box>
  );
}

interface NarrowTableProps extends ComparisonProps {
  readonly view: WindowView;
  readonly heading: string;
}

/** The comparison where there is little width: a row per signal, a column for each strategy of each variant. */
function NarrowTable({ resultView, words, signals, view: { window, statistic }, heading }: NarrowTableProps) {
  const groups = entryGroups(resultView);
  const metricOf = (signal: SignalKey) => ({ window, signal, statistic });
  return (
    <DataTable
      label={heading}
      captioned
      attributes={{ className: classes.comparison }}
      rows={signals}
      rowKey={(signal) => signal}
      columns={[
        {
          key: "signal",
          head: "",
          text: true,
          cell: (signal) => (
            <>
              {words.signal(signal)}{" "}
              <span className={ui.dim}>
                <UnitAndTools metric={metricOf(signal)} words={words} />
              </span>
            </>
          ),
        },
        ...variantColumns<SignalKey>(
          groups,
          (entry) => <EntryHead entry={entry} catalogue={words.catalogue} upright />,
          (entry) => ({
            attributes: (signal) => ({
              ...cellAttributes(entry, metricOf(signal)),
              "data-baseline": entry.isBaseline || undefined,
            }),
            cell: (signal) => (
              <ResultCell
                {...{ resultView, entry }}
                metric={metricOf(signal)}
                lowest={lowestOf(groups, metricOf(signal))}
                scale={words.unit(signal).scale}
              />
            ),
          }),
        ),
      ]}
    />
  );
}

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

function RunTable({ resultView }: { readonly resultView: ResultView }) {
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
        <span className={classes.value}>{showValue(value)}</span>
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
function variantColumns<Row>(
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
