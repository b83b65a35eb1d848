/** The comparison, and on demand everything else the run says in numbers. */

import { Button, Box, UnstyledButton } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useId, useState, type ReactNode } from "react";
import { Icon } from "../../ui/icons";
import { CompareBar } from "../compare/CompareBar";
import { type SignalKey } from "../../api/types";
import { Solve, SolveButton } from "../solve/SolveButton";
import { type ResultView } from "../../lab/resultView";
import classes from "./tables.module.css";
import { Card } from "../../ui/Card";
import { getAt } from "../../scenario/path";
import { whyNotCompared } from "../../lab/compare";
import { DataTable, type Column } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";
import {
  entryGroups,
  runRows,
  type RunRow,
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
import { useLabels, useCatalogue, type Labels } from "../../server/useCatalogues";
import { prettyUnit, formatFixed } from "../../units/format";
import { ChangeText, Estimated, CaveatMark } from "./ChangeMark";
import { metricName, valueAt, type MetricPath, type WindowMetric } from "../../lab/metricPath";
import { StrategyName, StrategyKey } from "../../ui/StrategyKey";
import { ManualLink } from "../../ui/ManualLink";
import { RequirementMarks } from "../requirements/RequirementsCard";
import { requiredOf } from "../requirements/judged";
import { Fault } from "../../ui/Messages";
import { useLabContext } from "../../lab/context";
import { caveatsOf } from "./change";

/** Windows too narrow, beside the form, for both halves of the comparison side by side; paper has no form. */
const NARROW = "screen and (max-width: 67.99em)";

export function Tables({ resultView }: { readonly resultView: ResultView }) {
  const words = useLabels();
  const { catalogue } = words;
  const [more, setMore] = useState(false);
  const id = useId();
  const others = catalogue.metric_signals.filter((signal) => !catalogue.paper_signals.includes(signal));
  const narrow = useMediaQuery(NARROW, false, { getInitialValueInEffect: false });
  const hasIntervals = [resultView, ...resultView.pins].some(({ shown }) => shown.over !== null);
  const compare = (signals: readonly SignalKey[], caption: string, of = "") =>
    narrow ? (
      VIEWS.map((view) => (
        <NarrowTable key={view.window} {...{ resultView, words, signals, view }} heading={`${words.view(view)}${of}`} />
      ))
    ) : (
      <ComparisonTable {...{ resultView, words, signals, caption }} />
    );
  return (
    <Card className={classes.comparison ?? ""} aria-label="Comparison" data-intervals={hasIntervals || undefined}>
      <CompareBar resultView={resultView} />
      <Solve />
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

function RunTable({ resultView }: { readonly resultView: ResultView }) {
  return (
    <DataTable
      label="Comfort, time and events"
      rows={runRows(useCatalogue())}
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
        ...variantColumns<RunRow>(
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
  readonly row: RunRow;
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

/** RMS on the rough road and peak on the bump, side by side, a row for each strategy of each variant. */
interface ComparisonProps {
  readonly resultView: ResultView;
  readonly words: Labels;
  readonly signals: readonly SignalKey[];
}

interface Props extends ComparisonProps {
  readonly caption: string;
}

function ComparisonTable({ caption, ...props }: Props) {
  const groups = entryGroups(props.resultView);
  return (
    <DataTable
      label={caption}
      attributes={{ className: classes.comparison }}
      columns={columnsOf(props)}
      groups={groups.map(({ name, entries }) => ({
        key: entries[0]?.key ?? name ?? "",
        ...(groups.length > 1 && { title: name ?? CURRENT }),
        rows: entries,
        attributes: { "data-pinned": name ?? undefined },
      }))}
      rowKey={({ key }) => key}
      rowAttributes={(entry) => ({
        "data-baseline": entry.isBaseline || undefined,
        [entry.shown === props.resultView.shown ? "data-strategy" : "data-pinned-strategy"]: entry.strategy.id,
      })}
    />
  );
}

function columnsOf({ resultView, words, signals }: ComparisonProps): readonly Column<Entry>[] {
  const groups = entryGroups(resultView);
  const results = VIEWS.flatMap((view) =>
    signals.map((signal): Column<Entry> => {
      const metric = { window: view.window, signal, statistic: view.statistic };
      const { scale } = words.unit(signal);
      const lowest = lowestOf(groups, metric);
      return {
        key: `${view.window} ${signal}`,
        group: words.view(view),
        head: words.signal(signal),
        detail: <UnitAndTools {...{ metric, words }} />,
        sort: ({ summary }) => valueAt(summary, metric),
        attributes: (entry) => cellAttributes(entry, metric),
        cell: (entry) => <ResultCell {...{ resultView, entry, metric, scale, lowest }} />,
      };
    }),
  );
  return [
    {
      key: "strategy",
      head: "Strategy",
      text: true,
      cell: (entry) => <EntryHead entry={entry} catalogue={words.catalogue} />,
    },
    ...results,
  ];
}

interface UnitProps {
  readonly metric: WindowMetric;
  readonly words: Labels;
}

function UnitAndTools({ metric: { window, signal, statistic }, words }: UnitProps) {
  const label = words.signal(signal);
  return (
    <>
      {words.unit(signal).unit}{" "}
      <span className={classes.tools}>
        <SolveButton metric={`${window}.${signal}.${statistic}`} label={`${label}, ${window.replace("_", " ")}`} />
        <ManualLink name={signal} label={label} />
      </span>
    </>
  );
}

interface ResultCellProps {
  readonly resultView: ResultView;
  readonly entry: Entry;
  readonly metric: MetricPath;
  /** From SI to the unit shown. */
  readonly scale: number;
  /** The lowest of the metric, in bold. */
  readonly lowest: number;
}

/** One number of the comparison, with its interval over several roads and its change. */
function ResultCell({ resultView, entry, metric, scale, lowest }: ResultCellProps) {
  const value = valueAt(entry.summary, metric);
  return (
    <>
      <Estimated
        value={value}
        isBest={value === lowest}
        interval={intervalAt(entry.shown, entry.strategy.id, metric)}
        scale={scale}
      />
      <ChangeText change={changeOf(resultView, entry, metric, scale)} />
      <RequirementMarks results={requiredOf(resultView.judged, entry, metricName(metric))} />
    </>
  );
}

/** What a cell is called and its unrounded value, for whoever looks for it. */
const cellAttributes = ({ summary }: Entry, metric: WindowMetric) => ({
  "data-cell": `${metric.window}.${metric.signal}.${metric.statistic}`,
  "data-value": valueAt(summary, metric) ?? "",
});

interface EntryHeadProps {
  readonly entry: Entry;
  readonly catalogue: Labels["catalogue"];
  /** For a column's head: name under its line. */
  readonly upright?: boolean;
}

/** Who a row or column is: the strategy, at which speed it met the bump, and the caveats of its result. */
function EntryHead({ entry: { strategy, summary, fault, isBaseline }, catalogue, upright = false }: EntryHeadProps) {
  const { labAddress } = useLabContext();
  const speed = summary?.arrival_speed_kmh;
  if (fault !== undefined)
    return (
      <span className={classes.entryHead} data-upright={upright || undefined}>
        <strong>
          <StrategyName strategy={strategy} />
        </strong>
        <Fault span style={{ overflowWrap: "anywhere" }}>
          {fault}
        </Fault>
      </span>
    );
  return (
    <span className={classes.entryHead} data-upright={upright || undefined}>
      <UnstyledButton
        className={classes.baselineButton ?? ""}
        aria-pressed={isBaseline}
        title={isBaseline ? "Changes are against this one" : `Compare with ${strategy.label}`}
        onClick={() => labAddress.setView({ baseline: strategy.id, reference: "baseline" })}
      >
        <StrategyKey strategy={strategy} />
        {strategy.label}
      </UnstyledButton>
      <span className={classes.entryFacts}>
        <span title="Speed at which the front axle meets the bump">
          {typeof speed === "number" ? `${formatFixed(speed, speed < 99.95 ? 1 : 0)}\u00a0km/h` : "–"}
        </span>
        {isBaseline && <span>baseline</span>}
        <ManualLink name={strategy.own ? `own.${strategy.id}` : strategy.id} label={strategy.label} />
        <CaveatMark caveats={caveatsOf(summary?.events, catalogue)} />
      </span>
    </span>
  );
}
