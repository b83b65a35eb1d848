/** Each field alone at both its ends (a tornado): which one breaks a strategy. */

import { Text } from "@mantine/core";
import { keepPreviousData, useQuery } from "@tanstack/react-query";
import { useState, type CSSProperties } from "react";
import { isFinal } from "../../jobs/follow";
import { ChartButton } from "../../plots/FigureButton";
import type { Batch } from "../../api/types";
import { type Metric, fullName, OPENING_METRIC } from "../../server/metrics";
import { tableQuery } from "../../features/sweep/table";
import { BATCH, jobQuery } from "../../jobs/useJob";
import { formatPercent } from "../../features/tables/change";
import { formatResult, prettyUnit } from "../../units/format";
import { nameOf, useFieldText } from "./names";
import { tornadoChart } from "./paperSpread";
import { isOneByOne, tornadoOf, type Bar, type End, type Tornado } from "./tornado";
import { TRAVEL, type StudyParts } from "./summary";
import { useOpenRun } from "../../features/sweep/useOpenRun";
import styles from "./bars.module.css";
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
  const fieldText = useFieldText();
  if (!figure) return null;
  const tornado = table.data ? tornadoOf(batch, table.data.columns, strategyId, figure.key) : null;
  const drawOnPaper = (shown: Tornado) =>
    tornadoChart(
      shown,
      figure,
      shown.bars.map(({ field }) => nameOf(field.name, [field])),
      shown.bars.map(({ field, low, high }) => [
        low ? fieldText(field.name, low.at) : "",
        high ? fieldText(field.name, high.at) : "",
      ]),
    );
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
          {tornado && (
            <ChartButton
              title={`Each field alone: ${fullName(figure)}`}
              file={`ridelab-${batch.id}-fields-${figure.key}`}
              draw={() => drawOnPaper(tornado)}
            />
          )}
        </>
      }
    >
      <Note className={ui.note ?? ""}>
        One field at its lowest and its highest value, all others as in the scenario. A bar to the right is worse. A
        click opens the run.
      </Note>
      {opening.error !== null && (
        <Fault size="md" className={ui.note ?? ""}>
          This run could not be opened: {opening.error}
        </Fault>
      )}
      {tornado ? (
        <Bars {...{ tornado, figure, opening, batch }} />
      ) : (
        <Text c="dimmed" className={ui.note ?? ""} role="status">
          {explanation}
        </Text>
      )}
    </Card>
  );
}

interface BarsProps extends Pick<StudyParts, "batch" | "opening"> {
  readonly tornado: Tornado;
  readonly figure: Metric;
}

/** Lengths are shares of the widest bar's; the style adds room for labels. */
const shares = (from: number, length = 0) => ({ "--from": from, "--length": length }) as CSSProperties;

function Bars({ tornado: { nominal, bars }, figure, opening, batch }: BarsProps) {
  const values = [nominal, ...bars.flatMap(({ low, high }) => [low, high].flatMap((end) => (end ? [end.value] : [])))];
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const width = Math.max(most - least, 1e-12);
  const offset = (value: number) => (value - least) / width;
  const base = `${formatResult(nominal * figure.scale)} ${prettyUnit(figure.unit)}`.trim();
  return (
    <div className={styles.tornado} data-testid="tornado">
      <div className={styles.tornadoRow} aria-hidden>
        <span />
        <span className={styles.tornadoTrack}>
          <span className={styles.tornadoBase} style={shares(offset(nominal))}>
            {base}
          </span>
        </span>
      </div>
      {bars.map((bar) => (
        <BarRow key={bar.field.name} {...{ bar, nominal, offset, figure, opening, batch }} />
      ))}
    </div>
  );
}

interface BarRowProps extends Omit<BarsProps, "tornado"> {
  readonly bar: Bar;
  readonly nominal: number;
  readonly offset: (value: number) => number;
}

function BarRow({ bar: { field, low, high }, nominal, offset, figure, opening, batch }: BarRowProps) {
  const ends = (
    [
      ["low", low],
      ["high", high],
    ] as const
  ).flatMap(([side, end]) => (end ? [{ side, end }] : []));
  const change = ({ value }: End) =>
    nominal === 0
      ? `${formatResult(value * figure.scale)} ${prettyUnit(figure.unit)}`
      : formatPercent(100 * (value / nominal - 1));
  const fieldText = useFieldText();
  const placeText = (end: End) => fieldText(field.name, end.at);
  return (
    <div className={styles.tornadoRow} data-field={field.name}>
      <span className={styles.tornadoName}>{nameOf(field.name, [field])}</span>
      <span className={styles.tornadoTrack}>
        <span className={styles.tornadoLine} style={shares(offset(nominal))} />
        {ends.map(({ side, end }) => {
          const [from, to] = [offset(Math.min(nominal, end.value)), offset(Math.max(nominal, end.value))];
          const left = end.value < nominal;
          const run = end.row - (end.row % batch.strategies.length);
          return (
            <button
              key={side}
              type="button"
              className={styles.tornadoBar}
              data-side={side}
              data-worse={!left || undefined}
              disabled={opening.opening !== null}
              style={shares(from, to - from)}
              title={`${field.title} ${placeText(end)}: ${change(end)}`}
              aria-label={`${field.title} ${placeText(end)}: ${change(end)}; open it in the lab`}
              onClick={() => opening.open({ run, at: typeof end.at === "undefined" ? {} : { [field.name]: end.at } })}
            >
              <span className={styles.tornadoLabel} data-left={left || undefined}>
                {placeText(end)} <b>{change(end)}</b>
              </span>
            </button>
          );
        })}
      </span>
    </div>
  );
}
