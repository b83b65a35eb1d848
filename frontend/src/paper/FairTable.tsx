/** Controller, speed, preview and weights varied one at a time, over the same roads: sortable, filterable. */

import { NativeSelect, SegmentedControl, Text, UnstyledButton } from "@mantine/core";
import { IconArrowsSort, IconSortAscending, IconSortDescending } from "../icons";
import { useState, type ReactNode } from "react";
import type { Combination } from "../api/types";
import { formatPercent } from "../tables/change";
import { count, formatFixed, formatResult } from "../units/format";
import { ANY, filtered, FILTERS, inOrder, metricKey, NO_FILTER, partOf, type Filter, type Order } from "./fair";
import classes from "./parts.module.css";
import tables from "./tables.module.css";
import { WindowHeads } from "./WindowHeads";
import type { Words } from "./words";
import { ScrollTable } from "../ui/ScrollTable";

interface Props {
  readonly rows: readonly Combination[];
  readonly words: Words;
}

type Shown = "change" | "value";

const COMFORT = "weighted_rms";

export function FairTable({ rows, words }: Props) {
  const [filter, setFilter] = useState<Filter>(NO_FILTER);
  const [order, setOrder] = useState<Order | null>(null);
  const [shown, setShown] = useState<Shown>("change");
  const listed = inOrder(filtered(rows, filter), order);
  const sort = (column: string) =>
    setOrder((before) => (before?.column === column ? (before.descending ? null : { column, descending: true }) : { column, descending: false }));
  const metrics = rows[0]?.metrics ?? [];
  const heads = { order, onSort: sort };
  return (
    <>
      <div className={classes.tools}>
        {FILTERS.map(({ name, label, options }) => (
          <NativeSelect
            key={name}
            size="xs"
            label={label}
            value={filter[name]}
            data={[{ value: ANY, label: "Any" }, ...options.map(([value, text]) => ({ value, label: text }))]}
            onChange={({ currentTarget: { value } }) => setFilter((before) => ({ ...before, [name]: value }))}
          />
        ))}
        <SegmentedControl
          size="xs"
          aria-label="Figures as"
          value={shown}
          data={[
            { value: "change", label: "Change against passive" },
            { value: "value", label: "Value and interval" },
          ]}
          onChange={setShown}
        />
        <Text size="sm" role="status">
          {listed.length === rows.length ? count(rows.length, "combination") : `${listed.length} of ${count(rows.length, "combination")}`}
        </Text>
      </div>
      <ScrollTable label="Combinations of controller, speed, preview and weights" card className={`${tables.table ?? ""} ${tables.combinations ?? ""}`} data-testid="combinations">
        <thead>
          <WindowHeads before={FILTERS.length + 2} metrics={metrics} words={words} />
          <tr>
            {FILTERS.map(({ name, label }, index) => (
              <Head key={name} column={name} sticky={index === 0} {...heads}>
                {label}
              </Head>
            ))}
            <Head column="travel_time" number {...heads}>
              {words.figure("travel_time")}
            </Head>
            <Head column={COMFORT} number {...heads}>
              {words.figure(COMFORT)}
            </Head>
            {metrics.map((metric) => (
              <Head key={metricKey(metric)} column={metricKey(metric)} number {...heads}>
                {words.signal(metric.signal)} {shown === "value" && <span className={tables.unit}>{words.unit(metric.signal).unit}</span>}
              </Head>
            ))}
          </tr>
        </thead>
        <tbody>
          {listed.map((row) => (
            <Row key={row.id} row={row} shown={shown} words={words} />
          ))}
        </tbody>
      </ScrollTable>
      {listed.length === 0 && <p className={classes.empty}>No combination is like that: the passive car has neither preview nor weights, LQR no weights to switch.</p>}
    </>
  );
}

interface HeadProps {
  readonly column: string;
  readonly order: Order | null;
  readonly onSort: (column: string) => void;
  readonly number?: boolean;
  readonly sticky?: boolean;
  readonly children: ReactNode;
}

function Head({ column, order, onSort, number = false, sticky = false, children }: HeadProps) {
  const sorted = order?.column === column ? order : null;
  const Icon = sorted === null ? IconArrowsSort : sorted.descending ? IconSortDescending : IconSortAscending;
  const look = [number ? tables.number : "", sticky ? tables.sticky : ""].join(" ");
  return (
    <th scope="col" className={look} aria-sort={sorted === null ? "none" : sorted.descending ? "descending" : "ascending"}>
      <UnstyledButton className={classes.sort ?? ""} data-number={number || undefined} onClick={() => onSort(column)}>
        <span>{children}</span>
        <Icon size={13} stroke={1.8} aria-hidden data-sorted={sorted !== null || undefined} />
      </UnstyledButton>
    </th>
  );
}

interface RowProps {
  readonly row: Combination;
  readonly shown: Shown;
  readonly words: Words;
}

function Row({ row, shown, words }: RowProps) {
  const comfort = row.comfort[COMFORT];
  return (
    <tr data-combination={row.id} data-known={row.is ?? undefined}>
      <th scope="row" className={tables.sticky}>
        {partOf(row, "controller")}
        {row.is !== null && <span className={classes.known}>{words.strategy(row.is)}</span>}
      </th>
      <td>{partOf(row, "speed")}</td>
      <td>{partOf(row, "preview")}</td>
      <td>{partOf(row, "weights")}</td>
      <td className={tables.number}>{formatFixed(row.travel_time, 1)}</td>
      <td className={tables.number}>
        {comfort ? formatResult(comfort.value) : "–"}
        {comfort && shown === "value" && <Interval {...comfort} scale={1} />}
      </td>
      {row.metrics.map((metric) => {
        const { scale } = words.unit(metric.signal);
        return (
          <td key={metricKey(metric)} className={tables.number}>
            {shown === "change" ? formatPercent(metric.change_vs_passive) : formatResult(metric.value * scale)}
            {shown === "value" && <Interval {...metric} scale={scale} />}
          </td>
        );
      })}
    </tr>
  );
}

function Interval({ low, high, scale }: { readonly low: number; readonly high: number; readonly scale: number }) {
  return (
    <span className={classes.interval}>
      {formatResult(low * scale)} to {formatResult(high * scale)}
    </span>
  );
}
