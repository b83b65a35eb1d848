/** Every run as a row, a page of them at a time, sorted by any column. */

import { ActionIcon, Checkbox, Pagination, Text, Tooltip, UnstyledButton } from "@mantine/core";
import { IconAlertTriangle, IconArrowsSort, IconExternalLink, IconSortAscending, IconSortDescending } from "../icons";
import { useMemo, useState } from "react";
import type { Batch, Catalogue, Strategy } from "../api/types";
import type { Markers } from "../plots/markers";
import { count, prettyUnit } from "../units/format";
import classes from "./batch.module.css";
import type { Figure } from "./figures";
import { MarkerKey } from "./MarkerKey";
import { showCell, showFigure } from "./show";
import { cell, ordered, rowsOf, type Columns, type Order } from "./table";
import { caveatsOfRow } from "./describeRow";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";
import { ScrollTable } from "../ui/ScrollTable";

interface Props {
  readonly batch: Batch;
  readonly columns: Columns;
  readonly catalogue: Catalogue;
  readonly strategies: readonly Strategy[];
  readonly markers: Markers;
  readonly figures: readonly Figure[];
  readonly best: number | null;
  readonly loading: boolean;
  /** The row whose run is being opened. */
  readonly opening: number | null;
  readonly onOpen: (row: number) => void;
}

const PAGE = 50;

export function BatchRows({ batch, columns, catalogue, strategies, markers, figures, best, loading, opening, onOpen }: Props) {
  const [order, setOrder] = useState<Order>({ column: "run", descending: false });
  const [failedOnly, setFailedOnly] = useState(false);
  const [page, setPage] = useState(1);

  const rows = useMemo(() => {
    const filtered = rowsOf(columns, (row) => !failedOnly || cell(columns, "status", row) === "failed");
    return ordered(columns, filtered, order);
  }, [columns, failedOnly, order]);
  const pages = Math.max(1, Math.ceil(rows.length / PAGE));
  const current = Math.min(page, pages);
  const shown = rows.slice((current - 1) * PAGE, current * PAGE);
  const sort = (column: string) => {
    setOrder({ column, descending: order.column === column && !order.descending });
    setPage(1);
  };
  const head = { order, onSort: sort };

  return (
    <Card aria-label="Rows">
      <div className={classes.rowsTools}>
        <Text size="sm" fw={600}>
          {count(rows.length, failedOnly ? "failed run" : "run")}
        </Text>
        {batch.failed > 0 && (
          <Checkbox
            size="xs"
            label="Failed only"
            checked={failedOnly}
            onChange={(event) => {
              setFailedOnly(event.currentTarget.checked);
              setPage(1);
            }}
          />
        )}
        <span className={classes.grow} />
        <Pagination
          size="sm"
          total={pages}
          value={current}
          onChange={setPage}
          getControlProps={(control) => ({ "aria-label": `${control} page` })}
          getItemProps={(item) => ({ "aria-label": `Page ${item}` })}
        />
      </div>
      <ScrollTable label="Runs of the sweep" className={classes.table}>
        <caption className="visually-hidden">Runs of the sweep, a page of {PAGE}</caption>
        <thead>
          <tr>
            <Heading {...head} column="run" title="Run" />
            {batch.fields.map(({ name, title, unit }) => (
              <Heading key={name} {...head} column={name} title={title} unit={unit} />
            ))}
            <Heading {...head} column="strategy" title="Strategy" left />
            {figures.map(({ key, label, group, unit }) => (
              <Heading key={key} {...head} column={key} title={label} detail={group} unit={unit} />
            ))}
          </tr>
        </thead>
        <tbody>
          {shown.map((row) => (
            <Row key={row} row={row} isBest={row === best} isOpening={row === opening} {...{ batch, columns, catalogue, strategies, markers, figures, onOpen }} />
          ))}
        </tbody>
      </ScrollTable>
      {shown.length === 0 && (
        <Text size="sm" c="dimmed" p="md">
          {loading ? "Loading the rows…" : failedOnly ? "No run has failed." : "There are no rows."}
        </Text>
      )}
    </Card>
  );
}

interface HeadingProps {
  readonly column: string;
  readonly title: string;
  readonly detail?: string;
  readonly unit?: string;
  readonly left?: boolean;
  readonly order: Order;
  readonly onSort: (column: string) => void;
}

function Heading({ column, title, detail, unit = "1", left = false, order, onSort }: HeadingProps) {
  const sorted = order.column === column;
  const Icon = !sorted ? IconArrowsSort : order.descending ? IconSortDescending : IconSortAscending;
  const small = [detail, prettyUnit(unit)].filter(Boolean).join(" · ");
  return (
    <th scope="col" data-left={left || undefined} aria-sort={sorted ? (order.descending ? "descending" : "ascending") : "none"}>
      <UnstyledButton className={classes.sort ?? ""} data-sorted={sorted || undefined} onClick={() => onSort(column)}>
        <span>
          {title}
          {small !== "" && <span className={classes.detail}>{small}</span>}
        </span>
        <Icon size={13} stroke={1.8} aria-hidden />
      </UnstyledButton>
    </th>
  );
}

type RowProps = Pick<Props, "batch" | "columns" | "catalogue" | "strategies" | "markers" | "figures" | "onOpen"> & {
  readonly row: number;
  readonly isBest: boolean;
  readonly isOpening: boolean;
};

function Row({ row, batch, columns, catalogue, strategies, markers, figures, isBest, isOpening, onOpen }: RowProps) {
  const run = Number(cell(columns, "run", row));
  const status = String(cell(columns, "status", row));
  const reason = cell(columns, "reason", row);
  const strategy = strategies.find(({ id }) => id === cell(columns, "strategy", row));
  const caveats = caveatsOfRow(columns, row, catalogue);
  return (
    <tr data-best={isBest || undefined} data-status={status} data-run={run}>
      <td>
        <span className={classes.runCell}>
          {isBest && (
            <Tooltip label="Lowest value of the plotted metric">
              <span className={classes.ring} role="img" aria-label="lowest" />
            </Tooltip>
          )}
          {run}
          <Tooltip label="Open in the dashboard" openDelay={400}>
            <ActionIcon size={24} variant="subtle" loading={isOpening} aria-label={`Open run ${run} in the dashboard`} onClick={() => onOpen(row)}>
              <IconExternalLink size={14} />
            </ActionIcon>
          </Tooltip>
        </span>
      </td>
      {batch.fields.map(({ name }) => (
        <td key={name}>{showCell(cell(columns, name, row))}</td>
      ))}
      <td data-left>
        <span className={classes.strategy}>
          {strategy && <MarkerKey strategy={strategy} symbol={markers[strategy.id]} />}
          {strategy?.label ?? String(cell(columns, "strategy", row))}
          {caveats.length > 0 && (
            <span
              role="img"
              className={classes.caveat}
              data-caveat={caveats.map(({ event }) => event).join(" ")}
              aria-label={caveats.map(({ text }) => text).join(", ")}
              title={caveats.map(({ text, description }) => `${text} (${description})`).join("\n")}
            >
              <IconAlertTriangle size={14} stroke={1.9} aria-hidden />
            </span>
          )}
        </span>
      </td>
      {status === "ok" ? (
        figures.map(({ key, scale }) => <td key={key}>{showFigure(cell(columns, key, row), scale)}</td>)
      ) : (
        <td colSpan={figures.length} data-left className={status === "failed" ? ui.error : classes.waiting}>
          <span className={classes.reason}>
            {status}
            {typeof reason === "string" && `: ${reason}`}
          </span>
        </td>
      )}
    </tr>
  );
}
