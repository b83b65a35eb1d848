/** Controller, speed, preview and weights varied one at a time, over the same roads: sortable, filterable. */

import { Box, Group, SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { Combination } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import { humanise } from "../../scenario/schema";
import { count, formatFixed, formatResult } from "../../units/format";
import ui from "../../ui/ui.module.css";
import { useLabels, type Labels } from "../../server/useCatalogues";
import { DataTable, type Column } from "../../ui/DataTable";
import { Choice } from "../../ui/Entry";

type Shown = "change" | "value";

const COMFORT = "weighted_rms";

export function FairTable({ rows }: { readonly rows: readonly Combination[] }) {
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
            data={Object.entries({ [ANY]: "Any", ...optionsOf(name) }).map(([value, label]) => ({ value, label }))}
            onPick={(value) => setFilter((before) => ({ ...before, [name]: value }))}
          />
        ))}
        <SegmentedControl
          aria-label="Figures as"
          value={shown}
          data={[
            { value: "change", label: "Change against passive" },
            { value: "value", label: "Value and interval" },
          ]}
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
