/** Which uncertainty a strategy’s figures follow: by rank over all points, and each field alone at both its ends. */

import { Box, SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { Batch } from "../../api/types";
import { type Metric, fullName, OPENING_METRIC } from "../../server/metrics";
import { formatFixed, formatResult, prettyUnit } from "../../units/format";
import { nameOf, useFieldText, RunButton } from "./RunButton";
import { humanise } from "../../scenario/schema";
import {
  hasOrder,
  matters,
  ranked,
  type Ranked,
  type Sensitivity,
  type StrategySummary,
  type StudyParts,
  TRAVEL,
} from "./study";
import { DataTable, type Column } from "../../ui/DataTable";
import { choicesOf, labelled, Choice, SCROLLED } from "../../ui/Entry";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { Note, Fault } from "../../ui/Messages";
import { keepPreviousData, useQuery } from "@tanstack/react-query";
import { useCatalogues } from "../../server/useCatalogues";
import { isFinal, BATCH, jobQuery } from "../../jobs/useJob";
import { tableQuery, useOpenRun } from "../../features/sweep/table";
import { formatPercent } from "../../features/tables/change";
import { isOneByOne, tornadoOf, type Bar, type End, type Tornado } from "./charts";

type Props = Pick<StudyParts, "batch" | "summary" | "strategies" | "figures">;

const STABILITY = "stability";

export function Matters({ batch, summary, strategies, figures }: Props) {
  const [strategyId, setStrategyId] = useState<string>(summary.baseline);
  const [of, setOf] = useState<"value" | "margin">("value");
  const strategy = strategies.find(({ id }) => id === strategyId) ?? strategies[0];
  const results = strategy && summary.strategies[strategy.id];
  if (!strategy || !results || !batch.fields.some(({ name }) => hasOrder(name))) return null;
  const against = strategies.find(({ id }) => id === summary.baseline)?.label ?? "";
  const margins = of === "margin" && strategy.id !== summary.baseline;
  const rows = ranked(sensitivitiesOf(results, figures, margins));
  return (
    <Card
      aria-label="Which uncertainty matters"
      title="Which uncertainty matters"
      tools={
        <>
          <SegmentedControl
            aria-label="Strategy"
            {...SCROLLED}
            value={strategy.id}
            data={labelled(strategies)}
            onChange={setStrategyId}
          />
          {strategy.id !== summary.baseline && (
            <SegmentedControl
              aria-label="What follows"
              {...SCROLLED}
              value={of}
              data={choicesOf({ value: "its value", margin: `its change against ${against}` })}
              onChange={setOf}
            />
          )}
        </>
      }
    >
      <Note className={ui.note ?? ""}>
        How much of a metric’s variation one field alone explains, in % of the ranks’ variance (Kruskal–Wallis), and
        Spearman’s rank correlation: + means that more of the field is worse. A field without a number is no more than
        chance makes (p ≥ 0.001). Fields the strategy does not read are left out.
      </Note>
      {rows.length === 0 ? (
        <Text c="dimmed" className={ui.note ?? ""}>
          Too few points have run, or nothing that varies reaches this strategy.
        </Text>
      ) : (
        <DataTable
          label="What matters"
          rows={rows}
          rowKey={({ field }) => field}
          rowAttributes={({ field }) => ({ "data-field": field })}
          columns={columnsOf(batch, figures, margins)}
        />
      )}
    </Card>
  );
}

function sensitivitiesOf(
  { figures: results, stability }: StrategySummary,
  figures: readonly Metric[],
  margins: boolean,
): Readonly<Record<string, readonly Sensitivity[]>> {
  const own = figures.map(
    ({ key }) => [key, (margins ? results[key]?.margin?.sensitivity : results[key]?.sensitivity) ?? []] as const,
  );
  return Object.fromEntries(margins ? own : [...own, [STABILITY, stability.sensitivity] as const]);
}

function columnsOf(batch: Batch, figures: readonly Metric[], margins: boolean): readonly Column<Ranked>[] {
  const sensitivity = (key: string, head: string, group?: string): Column<Ranked> => ({
    key,
    head,
    group,
    attributes: ({ cells }) => ({ "data-cell": key, style: { background: shadeOf(cells[key]) } }),
    cell: ({ cells }) => <Share sensitivity={cells[key]} />,
  });
  return [
    {
      key: "field",
      head: "Field",
      text: true,
      cell: ({ field }) => humanise(nameOf(field, batch.fields)),
    },
    ...figures.map(({ key, label, group }) => sensitivity(key, label, group)),
    ...(margins ? [] : [sensitivity(STABILITY, "Least damping")]),
  ];
}

const shareOf = (sensitivity: Sensitivity | undefined) =>
  sensitivity && matters(sensitivity) ? Math.round(100 * sensitivity.effect) : undefined;

function shadeOf(sensitivity: Sensitivity | undefined): string | undefined {
  const share = shareOf(sensitivity);
  return share === undefined ? undefined : `color-mix(in srgb, var(--accent) ${Math.min(55, share)}%, transparent)`;
}

function Share({ sensitivity }: { readonly sensitivity: Sensitivity | undefined }) {
  const share = shareOf(sensitivity);
  if (!sensitivity || share === undefined) return <span className={ui.dim}>·</span>;
  return (
    <>
      <b>{share < 1 ? "<1" : share}&#8239;%</b>
      <Box
        component="span"
        display="block"
        fz="xs"
      >{`${sensitivity.spearman < 0 ? "" : "+"}${formatFixed(sensitivity.spearman, 2)}`}</Box>
    </>
  );
}

interface AloneProps extends Pick<StudyParts, "figures" | "strategies"> {
  readonly id: string;
}

const REFRESH_MS = 2_000;

export function OneAtATime({ id, ...rest }: AloneProps) {
  // Its end is asked for: the page's one stream of events is the study's.
  const { data: batch, error } = useQuery({
    ...jobQuery(BATCH, id),
    refetchInterval: ({ state: { data } }) => data !== undefined && !isFinal(data) && REFRESH_MS,
  });
  if (!batch && !error) return null;
  if (batch && !error && isOneByOne(batch)) return <FieldAlone batch={batch} {...rest} />;
  return (
    <Card {...ALONE}>
      <Text c="dimmed" className={ui.note ?? ""} role="status">
        {error
          ? `Each field alone could not be read: ${error.message}`
          : "The sweep that this address names does not vary each field alone."}
      </Text>
    </Card>
  );
}

const ALONE = { "aria-label": "Each field alone", title: "Each field alone" };

function FieldAlone({ batch, figures, strategies }: Omit<AloneProps, "id"> & { readonly batch: Batch }) {
  const offered = [...figures, ...useCatalogues().figures.filter(({ key }) => key === TRAVEL)];
  const [figureKey, setFigure] = useState(OPENING_METRIC);
  const [strategyId, setStrategy] = useState(strategies.find(({ id }) => id === "lv")?.id ?? strategies[0]?.id ?? "");
  const figure = offered.find(({ key }) => key === figureKey) ?? offered[0];
  const keys = offered.map(({ key }) => key);
  const table = useQuery({ ...tableQuery(batch, keys), placeholderData: keepPreviousData });
  const opening = useOpenRun(batch);
  if (!figure) return null;
  const columns = table.data?.columns;
  const tornado = columns ? tornadoOf(batch, columns, strategyId, figure.key) : null;
  const explanation = table.isError
    ? `The rows could not be read: ${table.error.message}`
    : isFinal(batch) && table.data
      ? "This metric has no value for the scenario itself."
      : "Loading these runs…";
  return (
    <Card
      {...ALONE}
      tools={
        <>
          <Choice aria-label="Strategy alone" value={strategyId} data={labelled(strategies)} onPick={setStrategy} />
          <Choice
            aria-label="Metric alone"
            value={figure.key}
            data={offered.map((each) => ({ value: each.key, label: fullName(each) }))}
            onPick={setFigure}
          />
        </>
      }
    >
      <Note className={ui.note ?? ""}>
        One field at its lowest value and at its highest, all others as in the scenario; the field that matters most
        first. A click on a change opens its run.
      </Note>
      {opening.error !== null && (
        <Fault size="md" className={ui.note ?? ""}>
          This run could not be opened: {opening.error}
        </Fault>
      )}
      {tornado ? (
        <Ends {...{ tornado, figure, opening, batch }} />
      ) : (
        <Text c="dimmed" className={ui.note ?? ""} role="status">
          {explanation}
        </Text>
      )}
    </Card>
  );
}

interface EndsProps extends Pick<StudyParts, "batch" | "opening"> {
  readonly tornado: Tornado;
  readonly figure: Metric;
}

/** Both ends of each field: where they are, and what the figure comes to there. */
function Ends({ tornado: { nominal, bars }, figure: { scale, unit }, opening, batch }: EndsProps) {
  const fieldText = useFieldText();
  const shown = (value: number) => `${formatResult(value * scale)} ${prettyUnit(unit)}`.trim();
  const change = ({ value }: End) => (nominal === 0 ? shown(value) : formatPercent(100 * (value / nominal - 1)));
  const columnsOf = (side: "low" | "high", group: string): readonly Column<Bar>[] => [
    {
      key: `${side} field`,
      group,
      head: "field",
      cell: ({ field, [side]: end }) => end && fieldText(field.name, end.at),
    },
    {
      key: side,
      group,
      head: "change",
      detail: nominal === 0 ? "" : `of ${shown(nominal)}`,
      attributes: ({ [side]: end }) => ({ "data-bad": end !== null && end.value > nominal ? true : undefined }),
      cell: ({ field, [side]: end }) =>
        end && (
          <RunButton
            run={{
              run: end.row - (end.row % batch.strategies.length),
              value: end.value,
              at: end.at === undefined ? {} : { [field.name]: end.at },
            }}
            text={change(end)}
            what={`${field.title} ${fieldText(field.name, end.at)}:`}
            opening={opening}
          />
        ),
    },
  ];
  return (
    <DataTable
      label="Each field at its ends"
      attributes={{ "data-testid": "tornado", "data-dense": true }}
      rows={bars}
      rowKey={({ field }) => field.name}
      rowAttributes={({ field }) => ({ "data-field": field.name })}
      columns={[
        { key: "field", head: "Field", text: true, cell: ({ field }) => humanise(nameOf(field.name, [field])) },
        ...columnsOf("low", "At its lowest value"),
        ...columnsOf("high", "At its highest value"),
      ]}
    />
  );
}
