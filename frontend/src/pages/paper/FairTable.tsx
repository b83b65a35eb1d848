/** Controller, speed, preview and weights varied one at a time, over the same roads: sortable, filterable. */

import { Box, Group, SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { Combination } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import { count, formatFixed, formatResult } from "../../units/format";
import { ANY, filtered, FILTERS, metricKey, NO_FILTER, partOf, rankOf, type Filter } from "./fair";
import ui from "../../ui/ui.module.css";
import { DataTable, type Column } from "../../ui/DataTable";
import { Choice } from "../../ui/Entry";
import type { Labels } from "../../server/useCatalogues";

interface Props {
  readonly rows: readonly Combination[];
  readonly words: Labels;
}

type Shown = "change" | "value";

const COMFORT = "weighted_rms";

export function FairTable({ rows, words }: Props) {
  const [filter, setFilter] = useState<Filter>(NO_FILTER);
  const [shown, setShown] = useState<Shown>("change");
  const listed = filtered(rows, filter);
  return (
    <>
      <Group gap="0.5rem 0.8rem" align="flex-end" mb="0.6rem" data-unprinted>
        {FILTERS.map(({ name, label, options }) => (
          <Choice
            key={name}
            label={label}
            value={filter[name]}
            data={[{ value: ANY, label: "Any" }, ...options.map(([value, text]) => ({ value, label: text }))]}
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
    ...FILTERS.map(({ name, label }, index): Column<Combination> => ({
      key: name,
      head: label,
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
        key: metricKey(column),
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
