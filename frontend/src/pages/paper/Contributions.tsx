/** What each part of LV control contributes: the comparisons the paper does not make. */

import { Stack, Text, Box, Group, SegmentedControl } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { useChoices } from "./choices";
import { typeset, spreadOf } from "./numbers";
import classes from "./paper.module.css";
import { attributionQuery, Answered } from "./Waiting";
import { useLabels, type Labels } from "../../server/useCatalogues";
import { type Attribution, type Combination } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import { SureChange } from "../../features/tables/ChangeMark";
import ui from "../../ui/ui.module.css";
import { DataTable, type Column } from "../../ui/DataTable";
import { formatFixed, count, formatResult } from "../../units/format";
import { useCallback, useState } from "react";
import { Chart, type ChartFigure } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { chartLayout, referenceLine, type Palette } from "../../plots/palettes";
import { Card } from "../../ui/Card";
import { humanise } from "../../scenario/schema";
import { Choice, choicesOf } from "../../ui/Entry";

/** `enabled`: the cells come first. */
export function Contributions({ enabled }: { readonly enabled: boolean }) {
  const [choices] = useChoices();
  const words = useLabels();
  return (
    <Answered
      query={useQuery({ ...attributionQuery(choices), enabled })}
      waiting={
        enabled
          ? "Running every combination of controller, speed, preview and weights"
          : "Waiting for the runs of the tables"
      }
      height={1900}
    >
      {(data) => <Parts {...{ data, words }} />}
    </Answered>
  );
}

function Parts({ data, words }: { readonly data: Attribution; readonly words: Labels }) {
  return (
    <>
      <Stack component="ul" gap="0.35rem" maw="56rem" m={0} pl="1.1rem" fz="md" lh="1.5" data-testid="sentences">
        {data.sentences.map((sentence) => (
          <li key={sentence}>{typeset(sentence)}</li>
        ))}
      </Stack>
      <h3 className={classes.subtitle}>Shares of LV’s gain</h3>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        From an MPC with equal weights, without preview, at constant speed to LV control; {data.seeds} roads, Ridelab’s
        readings. The three can be added in six orders; each share is its average over them, of the logarithm of the
        mean (Shapley values), so the three make 100 %. A negative share makes the metric worse.
      </Text>
      <ShareBars shares={data.shares} words={words} />
      <h3 className={classes.subtitle}>Every combination</h3>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        Means over the same {data.seeds} roads. Slowing down helps comfort; the travel time says what it costs.
      </Text>
      <FairTable rows={data.rows} />
      <h3 className={classes.subtitle}>At equal speed</h3>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        Change of the first against the second, with its 95 % interval: ▼ better, ▲ worse, ≈ where the interval holds
        zero.
      </Text>
      <EqualSpeed pairs={data.equal_speed} words={words} />
    </>
  );
}

interface EqualSpeedProps {
  readonly pairs: Attribution["equal_speed"];
  readonly words: Labels;
}

type Pair = Attribution["equal_speed"][number];

/** Pairs at the same speed plan: what is left of a gain when nobody slows down alone. */
export function EqualSpeed({ pairs, words }: EqualSpeedProps) {
  const [first] = pairs;
  if (!first) return null;
  return (
    <DataTable
      label="At the same speed"
      card
      attributes={{ "data-testid": "equal-speed" }}
      rows={pairs}
      rowKey={({ label }) => label}
      columns={[
        { key: "pair", head: "At the same speed plan", text: true, cell: ({ label }) => typeset(label) },
        ...first.cells.map((metric, index): Column<Pair> => ({
          key: `${metric.window} ${metric.signal}`,
          group: words.view(metric),
          head: words.signal(metric.signal),
          cell({ cells }) {
            const cell = cells[index];
            if (!cell) return null;
            const { our_change: value, ci } = cell;
            const [low = null, high = null] = ci;
            return <SureChange {...{ value, low, high }}>{spreadOf(value, ci)}</SureChange>;
          },
        })),
      ]}
    />
  );
}

/** 3:1 and more on white and on #1a1b1e, and apart with any colour vision. */
const PARTS = [
  { part: "speed", label: "Lower speed", colour: "#7c5bd6" },
  { part: "preview", label: "Preview", colour: "#0d8f8f" },
  { part: "switching", label: "Weight switching", colour: "#c77700" },
] as const;

type Share = Attribution["shares"][number];

interface ShareBarsProps {
  readonly shares: readonly Share[];
  readonly words: Labels;
}

function ShareBars({ shares, words }: ShareBarsProps) {
  const { chart, button } = useChart({
    title: "Shares of LV’s gain",
    file: "ridelab-paper-shares",
    draw: useCallback(
      ({ palette }: Look) => ({
        figure: sharesFigure(shares, words, palette),
        table: [
          ["Metric", ...PARTS.map(({ label }) => `${label} [%]`)],
          ...shares.map((share) => [nameOf(share, words), ...PARTS.map(({ part }) => share[part])]),
        ],
      }),
      [shares, words],
    ),
  });
  return (
    <>
      <Card aria-label="Bars of the shares" pt="xs" mb="0.6rem">
        {button}
        <Chart
          {...chart}
          height={AROUND + ROW * shares.length}
          label="What lower speed, preview and weight switching add to LV’s gain. Every value stands in the table below."
        />
      </Card>
      <DataTable
        label="Shares of LV’s gain"
        card
        attributes={{ "data-testid": "shares" }}
        rows={shares}
        rowKey={({ window, signal }) => `${window} ${signal}`}
        columns={[
          {
            key: "metric",
            head: "Metric",
            text: true,
            cell: (share) => (
              <>
                {words.signal(share.signal)} <span className={ui.dim}>{words.view(share)}</span>
              </>
            ),
          },
          { key: "whole", head: "Whole change", cell: ({ total_change: change }) => <b>{formatPercent(change)}</b> },
          ...PARTS.map(({ part, label, colour }): Column<Share> => ({
            key: part,
            head: (
              <span className={ui.named}>
                <span className={ui.swatch} style={{ background: colour }} aria-hidden />
                {label}
              </span>
            ),
            cell: (share) => `${formatFixed(share[part], 0)} %`,
          })),
        ]}
      />
    </>
  );
}

/** Of a figure, and of the axis [px]. */
const [ROW, AROUND] = [36, 76];

const nameOf = (share: Share, words: Pick<Labels, "signal" | "view">) =>
  `${words.signal(share.signal)}, ${words.view(share)}`;

/** What adds stacks up to the right of zero, what takes away to the left of it. */
export function sharesFigure(
  shares: readonly Share[],
  words: Pick<Labels, "signal" | "view">,
  palette: Palette,
): ChartFigure {
  // In two lines: on a phone one would leave the bars a third of the width.
  const names = shares.map((share) => `${words.signal(share.signal)}<br>${words.view(share)}`);
  return {
    data: PARTS.map(({ part, label, colour }) => ({
      type: "bar",
      orientation: "h",
      name: label,
      x: shares.map((share) => share[part]),
      y: names,
      marker: { color: colour },
      hovertemplate: `${label} %{x:.0f} %<extra></extra>`,
    })),
    layout: chartLayout(palette, {
      barmode: "relative",
      margin: { l: 8, r: 16, t: 24, b: 48 },
      ...referenceLine(palette, "x", 100, "whole gain", "center"),
      xaxis: { title: { text: "Share [%]" }, zeroline: true, zerolinecolor: palette.zero },
      yaxis: { autorange: "reversed" },
    }),
  };
}

/** Controller, speed, preview and weights varied one at a time, over the same roads: sortable, filterable. */
type Shown = "change" | "value";

const COMFORT = "weighted_rms";

function FairTable({ rows }: { readonly rows: readonly Combination[] }) {
  const words = useLabels();
  const [filter, setFilter] = useState(NO_FILTER);
  const [shown, setShown] = useState<Shown>("change");
  const listed = filtered(rows, filter);
  return (
    <>
      <Group gap="0.5rem 0.8rem" align="flex-end" mb="0.6rem" data-unprinted>
        {FILTERS.map((name) => (
          <Choice
            key={name}
            label={humanise(name)}
            value={filter[name]}
            data={choicesOf({ [ANY]: "Any", ...optionsOf(name) })}
            onPick={(value) => setFilter((before) => ({ ...before, [name]: value }))}
          />
        ))}
        <SegmentedControl
          aria-label="Figures as"
          value={shown}
          data={choicesOf<Shown>({ change: "Change against passive", value: "Value and interval" })}
          onChange={setShown}
        />
        <Text role="status" lh="30px" c="dimmed">
          {listed.length === rows.length
            ? count(rows.length, "combination")
            : `${listed.length} of ${count(rows.length, "combination")}`}
        </Text>
      </Group>
      <DataTable
        label="Combinations of controller, speed, preview and weights"
        card
        attributes={{ "data-testid": "combinations" }}
        rows={listed}
        rowKey={({ id }) => id}
        rowAttributes={({ id, is }) => ({ "data-combination": id, "data-known": is ?? undefined })}
        columns={columnsOf(rows[0]?.metrics ?? [], shown === "value", words)}
        empty="No combination is like that: the passive car has neither preview nor weights, LQR no weights to switch."
      />
    </>
  );
}

function columnsOf(
  metrics: Combination["metrics"],
  withIntervals: boolean,
  words: Labels,
): readonly Column<Combination>[] {
  return [
    ...FILTERS.map((name, index): Column<Combination> => ({
      key: name,
      head: humanise(name),
      text: true,
      sort: (row) => rankOf(row, name),
      attributes: () => ({ style: { whiteSpace: "nowrap" } }),
      cell: (row) => (
        <>
          {partOf(row, name)}
          {index === 0 && row.is !== null && (
            <Box component="span" display="block" fz="xs" fw={600} c="var(--accent)">
              {words.strategy(row.is)}
            </Box>
          )}
        </>
      ),
    })),
    {
      key: "travel_time",
      head: words.figure("travel_time"),
      sort: ({ travel_time: time }) => time,
      cell: ({ travel_time: time }) => formatFixed(time, 1),
    },
    {
      key: COMFORT,
      head: words.figure(COMFORT),
      sort: ({ comfort }) => comfort[COMFORT]?.value,
      cell({ comfort }) {
        const value = comfort[COMFORT];
        return value ? (
          <Value text={formatResult(value.value)} interval={withIntervals && { ...value, scale: 1 }} />
        ) : (
          "–"
        );
      },
    },
    ...metrics.map((column, index): Column<Combination> => {
      const { unit, scale } = words.unit(column.signal);
      return {
        key: `${column.window} ${column.signal}`,
        group: words.view(column),
        head: words.signal(column.signal),
        detail: withIntervals ? unit : "",
        sort: (row) => row.metrics[index]?.value,
        cell({ metrics: own }) {
          const metric = own[index];
          if (!metric) return "–";
          return (
            <Value
              text={withIntervals ? formatResult(metric.value * scale) : formatPercent(metric.change_vs_passive)}
              interval={withIntervals && { ...metric, scale }}
            />
          );
        },
      };
    }),
  ];
}

interface ValueProps {
  readonly text: string;
  readonly interval: false | { readonly low: number; readonly high: number; readonly scale: number };
}

function Value({ text, interval }: ValueProps) {
  return (
    <>
      {text}
      {interval && (
        <span className={ui.under}>
          {formatResult(interval.low * interval.scale)} to {formatResult(interval.high * interval.scale)}
        </span>
      )}
    </>
  );
}

/** What there is to choose among, in words and in a meaningful order; `null` in a row means there is nothing to choose. */
const OPTIONS = {
  controller: { mpc: "MPC", lqr: "LQR", passive: "Passive" },
  speed: { constant: "Constant", planned: "Planned" },
  preview: { none: "None", wheelbase: "Front axle’s", lookahead: "Road ahead" },
  weights: { equal: "Equal", comfort: "Cruise’s", switched: "Switched" },
} as const;
type FilterName = keyof typeof OPTIONS;
const FILTERS = Object.keys(OPTIONS) as readonly FilterName[];

const optionsOf = (name: FilterName): Readonly<Record<string, string>> => OPTIONS[name];

export const ANY = "any";

export const NO_FILTER: Readonly<Record<FilterName, string>> = {
  controller: ANY,
  speed: ANY,
  preview: ANY,
  weights: ANY,
};

/** A part of a combination in words. */
export const partOf = (row: Combination, name: FilterName) => optionsOf(name)[row[name] ?? ""] ?? "–";

export const filtered = (rows: readonly Combination[], filter: typeof NO_FILTER) =>
  rows.filter((row) => FILTERS.every((name) => filter[name] === ANY || row[name] === filter[name]));

/** What has none comes first. */
export const rankOf = (row: Combination, name: FilterName) => Object.keys(OPTIONS[name]).indexOf(row[name] ?? "");
