/** RMS on the rough road and peak on the bump, side by side, a row for each strategy of each variant. */

import type { SignalKey } from "../../api/types";
import type { ResultView } from "../../lab/resultView";
import { formatFixed } from "../../units/format";
import { CURRENT, byStrategy, entryGroups, lowestOf, type Entry, changeOf, intervalAt, VIEWS } from "./entries";
import { type WindowMetric, metricName, valueAt, type MetricPath } from "../../lab/metricPath";
import classes from "./tables.module.css";
import { SolveButton } from "../solve/SolveButton";
import { Fault } from "../../ui/Messages";
import { DataTable, type Column } from "../../ui/DataTable";
import { ManualLink } from "../../ui/ManualLink";
import { ChangeText, Estimated, CaveatMark } from "./ChangeMark";
import { useLabContext } from "../../lab/context";
import { caveatsOf } from "./change";
import { StrategyKey, StrategyName } from "../../ui/StrategyKey";
import { requiredOf } from "../requirements/judged";
import { UnstyledButton } from "@mantine/core";
import { RequirementMarks } from "../requirements/RequirementsCard";
import type { Labels } from "../../server/useCatalogues";

export interface ComparisonProps {
  readonly resultView: ResultView;
  readonly words: Labels;
  readonly signals: readonly SignalKey[];
  /** What the rows of a variant, or those of a strategy, stand under. */
  readonly grouping: "variant" | "strategy";
}

interface Props extends ComparisonProps {
  readonly caption: string;
}

export function ComparisonTable({ caption, ...props }: Props) {
  const { resultView, grouping } = props;
  const variants = entryGroups(resultView);
  const groups = grouping === "strategy" ? byStrategy(variants) : variants;
  return (
    <DataTable
      label={caption}
      attributes={{ className: classes.comparison }}
      columns={columnsOf(props)}
      groups={groups.map(({ name, entries }) => ({
        key: entries[0]?.key ?? name ?? "",
        ...((groups.length > 1 || grouping === "strategy") && { title: name ?? CURRENT }),
        rows: entries,
        attributes: { "data-pinned": grouping === "variant" ? (name ?? undefined) : undefined },
      }))}
      rowKey={({ key }) => key}
      rowAttributes={(entry) => ({
        "data-baseline": entry.isBaseline || undefined,
        [entry.shown === props.resultView.shown ? "data-strategy" : "data-pinned-strategy"]: entry.strategy.id,
      })}
    />
  );
}

function columnsOf({ resultView, words, signals, grouping }: ComparisonProps): readonly Column<Entry>[] {
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
      cell: (entry) => <EntryHead entry={entry} catalogue={words.catalogue} byVariant={grouping === "strategy"} />,
    },
    ...results,
  ];
}

interface UnitProps {
  readonly metric: WindowMetric;
  readonly words: Labels;
}

export function UnitAndTools({ metric: { window, signal, statistic }, words }: UnitProps) {
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
export function ResultCell({ resultView, entry, metric, scale, lowest }: ResultCellProps) {
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
export const cellAttributes = ({ summary }: Entry, metric: WindowMetric) => ({
  "data-cell": `${metric.window}.${metric.signal}.${metric.statistic}`,
  "data-value": valueAt(summary, metric) ?? "",
});

interface EntryHeadProps {
  readonly entry: Entry;
  readonly catalogue: Labels["catalogue"];
  /** For a column's head: name under its line. */
  readonly upright?: boolean;
  /** Called by its variant: its strategy stands above it. */
  readonly byVariant?: boolean;
}

/** Who a row or column is: the strategy, at which speed it met the bump, and the caveats of its result. */
export function EntryHead({
  entry: { strategy, variant, summary, fault, isBaseline },
  catalogue,
  upright = false,
  byVariant = false,
}: EntryHeadProps) {
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
        {byVariant ? (variant ?? CURRENT) : strategy.label}
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
