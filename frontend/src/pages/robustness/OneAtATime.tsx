/** Each field alone at both its ends (a tornado): which one breaks a strategy. */

import { Text, useComputedColorScheme } from "@mantine/core";
import { keepPreviousData, useQuery } from "@tanstack/react-query";
import { useRef, useState } from "react";
import { isFinal } from "../../jobs/follow";
import { ChartButton } from "../../plots/FigureButton";
import type { Batch } from "../../api/types";
import { type Metric, fullName, OPENING_METRIC } from "../../server/metrics";
import { tableQuery } from "../../features/sweep/table";
import { BATCH, jobQuery } from "../../jobs/useJob";
import { formatPercent } from "../../features/tables/change";
import { formatResult, prettyUnit } from "../../units/format";
import { humanise } from "../../scenario/schema";
import { nameOf, useFieldText } from "./names";
import { tornadoChart } from "./charts";
import { RunButton } from "./RunButton";
import { Chart } from "../../plots/Chart";
import { ON_PAPER, PALETTES, type Palette } from "../../plots/palettes";
import { DataTable, type Column } from "../../ui/DataTable";
import { isOneByOne, tornadoOf, type Bar, type End, type Tornado } from "./tornado";
import { TRAVEL, type StudyParts } from "./summary";
import { useOpenRun } from "../../features/sweep/useOpenRun";
import { Choice, labelled } from "../../ui/Entry";
import { Fault, Note } from "../../ui/Messages";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";

interface Props extends Pick<StudyParts, "figures" | "strategies"> {
  readonly id: string;
  /** The keys offered first are these figures'. */
  readonly paper: readonly Metric[];
}

const REFRESH_MS = 2_000;

export function OneAtATime({ id, ...rest }: Props) {
  // Its end is asked for: the page's one stream of events is the study's.
  const { data: batch, error } = useQuery({
    ...jobQuery(BATCH, id),
    refetchInterval: ({ state: { data } }) => data !== undefined && !isFinal(data) && REFRESH_MS,
  });
  if (error) return <Message text={`Each field alone could not be read: ${error.message}`} />;
  if (!batch) return null;
  if (!isOneByOne(batch)) return <Message text="The sweep that this address names does not vary each field alone." />;
  return <FieldAlone batch={batch} {...rest} />;
}

function Message({ text }: { readonly text: string }) {
  return (
    <Card aria-label="Each field alone" title="Each field alone">
      <Text c="dimmed" className={ui.note ?? ""} role="status">
        {text}
      </Text>
    </Card>
  );
}

function FieldAlone({ batch, figures, paper, strategies }: Omit<Props, "id"> & { readonly batch: Batch }) {
  const offered = [...paper, ...figures.filter(({ key }) => key === TRAVEL)];
  const [figureKey, setFigure] = useState(OPENING_METRIC);
  const [strategyId, setStrategy] = useState(strategies.find(({ id }) => id === "lv")?.id ?? strategies[0]?.id ?? "");
  const figure = offered.find(({ key }) => key === figureKey) ?? offered[0];
  const table = useQuery({
    ...tableQuery(
      batch,
      offered.map(({ key }) => key),
    ),
    placeholderData: keepPreviousData,
  });
  const opening = useOpenRun(batch);
  const palette = PALETTES[useComputedColorScheme("light")];
  const host = useRef<HTMLDivElement>(null);
  const fieldText = useFieldText();
  if (!figure) return null;
  const tornado = table.data ? tornadoOf(batch, table.data.columns, strategyId, figure.key) : null;
  const drawn = tornado && ((look: Palette) => tornadoChart(tornado, figure, fieldText, look));
  const explanation = table.isError
    ? `The rows could not be read: ${table.error.message}`
    : isFinal(batch) && table.data
      ? "This metric has no value for the scenario itself."
      : "Loading these runs…";
  return (
    <Card
      aria-label="Each field alone"
      title="Each field alone"
      tools={
        <>
          <Choice aria-label="Strategy alone" value={strategyId} data={labelled(strategies)} onPick={setStrategy} />
          <Choice
            aria-label="Metric alone"
            value={figure.key}
            data={offered.map((each) => ({ value: each.key, label: fullName(each) }))}
            onPick={setFigure}
          />
          {drawn && (
            <ChartButton
              title={`Each field alone: ${fullName(figure)}`}
              file={`ridelab-${batch.id}-fields-${figure.key}`}
              hostRef={host}
              draw={() => drawn(ON_PAPER)}
            />
          )}
        </>
      }
    >
      <Note className={ui.note ?? ""}>
        One field at its lowest value (light) and its highest (dark), all others as in the scenario. A bar to the right
        is worse. A click on a change opens its run.
      </Note>
      {opening.error !== null && (
        <Fault size="md" className={ui.note ?? ""}>
          This run could not be opened: {opening.error}
        </Fault>
      )}
      {tornado && drawn ? (
        <>
          <Chart
            hostRef={host}
            figure={drawn(palette).figure}
            height={AROUND + ROW * tornado.bars.length}
            label={`${fullName(figure)} with each field alone at both its ends. Every value stands in the table below.`}
          />
          <Ends {...{ tornado, figure, opening, batch }} />
        </>
      ) : (
        <Text c="dimmed" className={ui.note ?? ""} role="status">
          {explanation}
        </Text>
      )}
    </Card>
  );
}

/** Of a field, and of the axis [px]. */
const [ROW, AROUND] = [28, 70];

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
