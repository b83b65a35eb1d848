/** Every run as a row, a page of them at a time, sorted by any column. */

import { ActionIcon, Box, Checkbox, Group, Pagination, Text } from "@mantine/core";
import { useMemo, useState } from "react";
import { Icon } from "../../ui/icons";
import { count, prettyUnit } from "../../units/format";
import { MarkerKey } from "./PlotTools";
import {
  cell,
  REQUIRED,
  rowsOf,
  showCell,
  showFigure,
  textCell,
  type Cell,
  type Columns,
} from "../../features/sweep/table";
import { ResultMark } from "../../features/requirements/RequirementsCard";
import { caveatsOfRow, type SweepParts } from "./view";
import type { Metric } from "../../server/metrics";
import { Card } from "../../ui/Card";
import { DataTable, type Column } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";
import { CaveatMark } from "../../features/tables/ChangeMark";
import { useCatalogue } from "../../server/useCatalogues";

interface Props extends Pick<SweepParts, "batch" | "columns" | "strategies" | "best" | "onOpen"> {
  readonly figures: readonly Metric[];
  readonly loading: boolean;
  /** The row whose run is being opened. */
  readonly opening: number | null;
}

const PAGE = 50;

export function BatchRows(props: Props) {
  const { batch, columns, best, loading } = props;
  const [failedOnly, setFailedOnly] = useState(false);
  const [page, setPage] = useState(1);

  const rows = useMemo(
    () => rowsOf(columns, (row) => !failedOnly || statusOf(columns, row) === "failed"),
    [columns, failedOnly],
  );
  const pages = Math.max(1, Math.ceil(rows.length / PAGE));
  const current = Math.min(page, pages);

  return (
    <Card aria-label="Rows">
      <Group gap="0.4rem 1rem" mih="2.8rem" px="0.9rem" py="0.4rem">
        <Text fw={600}>
          {loading && rows.length === 0 ? "Runs" : count(rows.length, failedOnly ? "failed run" : "run")}
        </Text>
        {batch.failed > 0 && (
          <Checkbox
            label="Failed only"
            checked={failedOnly}
            onChange={(event) => {
              setFailedOnly(event.currentTarget.checked);
              setPage(1);
            }}
          />
        )}
        <Pagination
          size="sm"
          ml="auto"
          total={pages}
          value={current}
          onChange={setPage}
          getControlProps={(control) => ({ "aria-label": `${control} page` })}
          getItemProps={(item) => ({ "aria-label": `Page ${item}` })}
        />
      </Group>
      <DataTable
        label={`Runs of the sweep, a page of ${PAGE}`}
        rows={rows}
        rowKey={(row) => row}
        rowAttributes={(row) => ({
          "data-best": row === best || undefined,
          "data-status": statusOf(columns, row),
          "data-run": runOf(columns, row),
        })}
        columns={columnsOf(props)}
        order={BY_RUN}
        attributes={{ "data-dense": true }}
        onSort={() => setPage(1)}
        page={[(current - 1) * PAGE, current * PAGE]}
        empty={loading ? "Loading the rows…" : failedOnly ? "No run has failed." : "There are no rows."}
      />
    </Card>
  );
}

const BY_RUN = { column: "run", descending: false };

const runOf = (columns: Columns, row: number) => Number(cell(columns, "run", row));
const statusOf = (columns: Columns, row: number) => textCell(columns, "status", row);

function columnsOf(props: Props): readonly Column<number>[] {
  const { batch, columns, strategies, figures } = props;
  const sort = (name: string) => (row: number) => cell(columns, name, row);
  const ran = (row: number) => statusOf(columns, row) === "ok";
  return [
    { key: "run", head: "Run", sort: sort("run"), cell: (row) => <Run {...props} row={row} /> },
    ...batch.fields.map(({ name, title, unit }): Column<number> => ({
      key: name,
      head: title,
      detail: prettyUnit(unit),
      sort: sort(name),
      cell: (row) => showCell(cell(columns, name, row)),
    })),
    {
      key: "strategy",
      head: "Strategy",
      text: true,
      sort: (row) => strategies.find(({ id }) => id === cell(columns, "strategy", row))?.label,
      cell: (row) => <Driven {...props} row={row} />,
    },
    ...(columns[REQUIRED]
      ? [
          {
            key: REQUIRED,
            head: "Required",
            text: true,
            sort: sort(REQUIRED),
            cell: (row: number) => <Required result={cell(columns, REQUIRED, row)} />,
          },
        ]
      : []),
    ...figures.map(({ key, label, group, unit, scale }, index): Column<number> => ({
      key,
      head: label,
      group,
      detail: prettyUnit(unit),
      sort: sort(key),
      span: (row) => (ran(row) || index > 0 ? 1 : figures.length),
      attributes: (row) => ({ "data-text": !ran(row) || undefined }),
      cell: (row) =>
        ran(row) ? showFigure(cell(columns, key, row), scale) : <Unfinished columns={columns} row={row} />,
    })),
  ];
}

interface CellProps extends Props {
  readonly row: number;
}

function Run({ columns, row, best, opening, onOpen }: CellProps) {
  const run = runOf(columns, row);
  return (
    <span className={ui.named}>
      {row === best && (
        <Box
          component="span"
          data-hint="Lowest value of the plotted metric"
          w={10}
          h={10}
          bd="2px solid var(--text)"
          bdrs="50%"
          role="img"
          aria-label="lowest"
        />
      )}
      {run}
      <ActionIcon
        data-hint="Open in the dashboard"
        size={24}
        variant="subtle"
        loading={row === opening}
        aria-label={`Open run ${run} in the dashboard`}
        onClick={() => onOpen(row)}
      >
        <Icon name="ExternalLink" size={14} />
      </ActionIcon>
    </span>
  );
}

function Driven({ columns, strategies, row }: CellProps) {
  const catalogue = useCatalogue();
  const strategy = strategies.find(({ id }) => id === cell(columns, "strategy", row));
  return (
    <span className={ui.named}>
      {strategy && <MarkerKey strategy={strategy} />}
      {strategy?.label ?? textCell(columns, "strategy", row)}
      <CaveatMark caveats={caveatsOfRow(columns, row, catalogue)} short />
    </span>
  );
}

function Required({ result }: { readonly result: Cell }) {
  return result === "pass" || result === "fail" || result === "uncertain" ? <ResultMark result={result} /> : "–";
}

/** What became of a run that has no results, and why. */
function Unfinished({ columns, row }: Pick<CellProps, "columns" | "row">) {
  const [status, reason] = [statusOf(columns, row), cell(columns, "reason", row)];
  return (
    <Box
      component="span"
      display="inline-block"
      maw="min(44rem, 60vw)"
      c={status === "failed" ? "var(--danger)" : "dimmed"}
    >
      {status}
      {typeof reason === "string" && `: ${reason}`}
    </Box>
  );
}
