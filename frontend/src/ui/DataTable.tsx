/** The page's table: its columns are data, its first column is the rows' names and stays in sight when it scrolls sideways. */

import { Box, Text, UnstyledButton } from "@mantine/core";
import { useState, type HTMLAttributes, type ReactNode } from "react";
import { Icon } from "./icons";
import { inOrder, type Order } from "../lib/order";
import classes from "./table.module.css";
import ui from "./ui.module.css";

type Attributes = HTMLAttributes<HTMLElement> &
  Readonly<Record<`data-${string}`, string | number | boolean | null | undefined>>;

export interface Column<Row> {
  readonly key: string;
  readonly head: ReactNode;
  /** In small under the head: a unit, or what the column is of. */
  readonly detail?: ReactNode;
  readonly help?: string;
  /** Over this column and its neighbours of the same group. */
  readonly group?: ReactNode;
  /** Words, which stand at the left; numbers stand at the right. */
  readonly text?: boolean;
  /** Only on a screen, where it can be pressed. */
  readonly unprinted?: boolean;
  readonly headAttributes?: Attributes;
  readonly cell: (row: Row) => ReactNode;
  readonly attributes?: (row: Row) => Attributes;
  /** How many columns the cell takes; one where this is left out. */
  readonly span?: (row: Row) => number;
  /** The value to sort by: with it the head is a button. */
  readonly sort?: (row: Row) => unknown;
}

export interface RowGroup<Row> {
  readonly key: string;
  readonly title?: ReactNode;
  /** Heads of the group's own, after the title. */
  readonly heads?: readonly ReactNode[];
  readonly rows: readonly Row[];
  /** In a row under the others. */
  readonly note?: ReactNode;
  readonly attributes?: Attributes;
}

interface Props<Row> {
  /** Of the region that scrolls, and the caption. */
  readonly label: string;
  readonly columns: readonly Column<Row>[];
  readonly rows?: readonly Row[];
  readonly groups?: readonly RowGroup<Row>[];
  readonly rowKey: (row: Row) => string | number;
  readonly rowAttributes?: (row: Row) => Attributes;
  readonly order?: Order;
  readonly onSort?: () => void;
  /** The first row shown and the one after the last, of the sorted ones. */
  readonly page?: readonly [from: number, to: number];
  /** In place of rows. */
  readonly empty?: ReactNode;
  /** On a surface of its own. */
  readonly card?: boolean;
  readonly captioned?: boolean;
  /** At most; the heads stay when it scrolls. */
  readonly height?: string;
  readonly attributes?: Attributes;
}

const CAPTION = { p: "0.5rem 0.9rem 0", fz: "xs", fw: 600, ta: "left" } as const;

export function DataTable<Row>({
  label,
  columns,
  rows = [],
  groups = [{ key: "", rows }],
  rowKey,
  rowAttributes,
  order: initial,
  onSort,
  page,
  empty,
  card = false,
  captioned = false,
  height,
  attributes = {},
}: Props<Row>) {
  const [clicked, setOrder] = useState<Order | undefined>();
  const order = clicked ?? initial;
  const sort = (column: string) => {
    const again = order?.column === column;
    setOrder(again && order.descending ? undefined : { column, descending: again });
    onSort?.();
  };
  const valueOf = columns.find(({ key }) => key === order?.column)?.sort;
  const shown = groups.map((group) => ({
    ...group,
    rows: (valueOf ? inOrder(group.rows, valueOf, order?.descending) : group.rows).slice(...(page ?? [])),
  }));
  const { className = "", ...rest } = attributes;
  return (
    <div
      className={`${classes.scroll} ${card ? ui.card : ""}`}
      tabIndex={0}
      role="region"
      aria-label={label}
      style={{ maxHeight: height }}
    >
      <table className={`${classes.table} ${className}`} {...rest}>
        <Box component="caption" {...(captioned ? CAPTION : { className: "visually-hidden" })}>
          {label}
        </Box>
        <thead>
          <GroupHeads columns={columns} />
          <tr>
            {columns.map((column, index) => (
              <Head key={column.key} {...{ column, order }} first={beginsGroup(columns, index)} onSort={sort} />
            ))}
          </tr>
        </thead>
        {shown.map((group) => (
          <tbody key={group.key} {...group.attributes}>
            {group.title !== undefined && <GroupRow group={group} columns={columns} />}
            {group.rows.map((row) => (
              <tr key={rowKey(row)} {...rowAttributes?.(row)}>
                <Cells row={row} columns={columns} />
              </tr>
            ))}
            {group.note !== undefined && (
              <tr>
                <Box component="td" colSpan={columns.length} ta="left" c="dimmed">
                  <span className={classes.still}>{group.note}</span>
                </Box>
              </tr>
            )}
          </tbody>
        ))}
      </table>
      {empty !== undefined && shown.every((group) => group.rows.length === 0) && (
        <Text p="1rem" size="md" c="dimmed">
          {empty}
        </Text>
      )}
    </div>
  );
}

interface Columns<Row> {
  readonly columns: readonly Column<Row>[];
}

/** A line stands between groups of columns. */
const beginsGroup = <Row,>(columns: readonly Column<Row>[], index: number) =>
  (index > 0 && columns[index]?.group !== columns[index - 1]?.group) || undefined;

function GroupHeads<Row>({ columns }: Columns<Row>) {
  if (columns.every(({ group }) => group === undefined)) return null;
  const starts = columns.flatMap((_, index) => (index === 0 || beginsGroup(columns, index) ? [index] : []));
  return (
    <tr>
      {starts.map((start, index) => {
        const group = columns[start]?.group;
        const colSpan = (starts[index + 1] ?? columns.length) - start;
        return group === undefined ? (
          <td key={start} colSpan={colSpan} />
        ) : (
          <th
            key={start}
            colSpan={colSpan}
            scope="colgroup"
            className={classes.group}
            data-first={start > 0 || undefined}
          >
            {group}
          </th>
        );
      })}
    </tr>
  );
}

interface HeadProps<Row> {
  readonly column: Column<Row>;
  readonly first: true | undefined;
  readonly order: Order | undefined;
  readonly onSort: (column: string) => void;
}

function Head<Row>({
  column: { key, head, detail, help, text, unprinted, headAttributes, sort },
  first,
  order,
  onSort,
}: HeadProps<Row>) {
  const look = { "data-text": text, "data-first": first, "data-unprinted": unprinted, title: help, ...headAttributes };
  if (head === "") return <td {...look} />;
  const under = detail !== undefined && detail !== "" && <span className={ui.under}>{detail}</span>;
  // A button stands in no other.
  const hasButton = typeof detail === "object";
  if (!sort) {
    return (
      <th scope="col" {...look}>
        {head} {under}
      </th>
    );
  }
  const sorted = order?.column === key ? (order.descending ? "descending" : "ascending") : "none";
  const icon = ({ none: "ArrowsSort", ascending: "SortAscending", descending: "SortDescending" } as const)[sorted];
  return (
    <th scope="col" aria-sort={sorted} {...look}>
      <UnstyledButton className={classes.sort ?? ""} onClick={() => onSort(key)}>
        <span>
          {head} {!hasButton && under}
        </span>
        <Icon name={icon} size={13} stroke={1.8} />
      </UnstyledButton>{" "}
      {hasButton && under}
    </th>
  );
}

function GroupRow<Row>({ group: { title, heads }, columns }: Columns<Row> & { readonly group: RowGroup<Row> }) {
  return (
    <tr className={classes.groupRow}>
      <th scope="rowgroup" data-text colSpan={heads ? 1 : columns.length}>
        {heads ? title : <span className={classes.still}>{title}</span>}
      </th>
      {heads?.map((head, index) => {
        const { key, text, headAttributes } = columns[index + 1] ?? {};
        const look = { "data-text": text, "data-first": beginsGroup(columns, index + 1), ...headAttributes };
        return head === "" ? (
          <td key={key} {...look} />
        ) : (
          <th key={key} scope="col" {...look}>
            {head}
          </th>
        );
      })}
    </tr>
  );
}

function Cells<Row>({ row, columns }: Columns<Row> & { readonly row: Row }) {
  let taken = 0;
  return columns.map(({ key, text, unprinted, cell, attributes, span }, index) => {
    if (index < taken) return null;
    const colSpan = span?.(row) ?? 1;
    taken = index + colSpan;
    const look = {
      "data-text": text,
      "data-first": beginsGroup(columns, index),
      "data-unprinted": unprinted,
      ...(colSpan > 1 && { colSpan }),
      ...attributes?.(row),
    };
    const [Tag, scope] = index === 0 ? (["th", "row"] as const) : (["td", undefined] as const);
    return (
      <Tag key={key} {...{ scope, ...look }}>
        {cell(row)}
      </Tag>
    );
  });
}
