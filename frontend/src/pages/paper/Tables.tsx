/** The paper's comparing tables, each with ours beside it: what it prints, what comes out here, the verdict. */

import { Anchor, Box, Text } from "@mantine/core";
import { Icon } from "../../ui/icons";
import type { Paper, PaperCell, PaperJudgement, PaperTable } from "../../api/types";
import { formatPercent } from "../../features/tables/change";
import { formatResult } from "../../units/format";
import { printedChange, printedValue, spreadOf, typeset } from "./numbers";
import classes from "./paper.module.css";
import { VerdictMark, cellId } from "./Verdict";
import { useLabels, type Labels } from "../../server/useCatalogues";
import { DataTable, type Column, type RowGroup } from "../../ui/DataTable";
import ui from "../../ui/ui.module.css";

export function Tables({ paper }: { readonly paper: Paper }) {
  return (
    <>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        The paper’s columns are as printed; ours are means over {paper.seeds} roads, changes with their 95 % interval in
        percentage points. A{" "}
        <Text span td="underline dotted var(--worse)">
          misprint
        </Text>{" "}
        is a printed change that does not follow from the absolutes printed beside it; the verdict is taken against the
        one that does. The absolutes are not the measure: the parameters the paper prints do not give its own passive
        car (<Anchor href="#errata">errata</Anchor>
        ). Tables 1–3 and 6 are inputs: the fuzzy rules, the vehicle and the weights are in the{" "}
        <Anchor href="#count">scenario</Anchor>.
      </Text>
      {paper.tables.map((table) => (
        <Table
          key={table.number}
          table={table}
          cells={paper.cells.filter((cell) => cell.table === table.number)}
          reason={paper.unavailable?.reason}
        />
      ))}
    </>
  );
}

interface TableProps {
  readonly table: PaperTable;
  readonly cells: readonly PaperCell[];
  /** Why cells are not available, where there are such. */
  readonly reason: string | undefined;
}

function Table({ table, cells, reason }: TableProps) {
  const words = useLabels();
  return (
    <div className={classes.tableBlock} style={{ scrollMarginTop: "3.6rem" }} id={`table-${table.number}`}>
      <h3 className={classes.subtitle}>
        Table {table.number}{" "}
        <Text span inherit fw={400} c="dimmed" ml="0.4rem">
          {table.title}
        </Text>
      </h3>
      <DataTable
        label={`Table ${table.number}: ${table.title}`}
        card
        attributes={{ "data-table": table.number }}
        columns={columnsOf(cells[0], words)}
        groups={table.columns.map(({ strategy, against }) =>
          groupOf(
            words.strategy(strategy),
            words.strategy(against),
            cells.filter((cell) => cell.strategy === strategy && cell.against === against),
            reason,
          ),
        )}
        rowKey={(cell) => cellId(cell)}
        rowAttributes={(cell) => ({ id: cellId(cell), "data-verdict": cell.verdict })}
      />
    </div>
  );
}

/** A strategy against another: its columns have their names. */
function groupOf(
  strategy: string,
  against: string,
  rows: readonly PaperCell[],
  reason: string | undefined,
): RowGroup<PaperCell> {
  const heads = [strategy, against, "Change"];
  return {
    key: `${strategy} ${against}`,
    title: (
      <>
        {strategy}
        <span className={ui.under}>against {against}</span>
      </>
    ),
    heads: [...heads, ...heads, "", ""],
    rows,
    ...(reason !== undefined &&
      rows.some(({ verdict }) => verdict === "unavailable") && { note: <>{typeset(reason)}.</> }),
  };
}

function columnsOf(first: PaperCell | undefined, words: Labels): readonly Column<PaperCell>[] {
  const shown = (value: number | null, { signal, our_factor: factor }: PaperCell) =>
    value === null ? "–" : formatResult(value * words.unit(signal).scale) + (factor === 1 ? "" : ` (×${factor})`);
  const [paper, here] = [
    { group: "Paper", head: "" },
    { group: "Here", head: "" },
  ];
  const verdict = { text: true, attributes: () => ({ style: { minWidth: "9.6rem" } }) };
  return [
    {
      key: "signal",
      head: first ? words.view(first) : "",
      text: true,
      cell: (cell) => <Signal cell={cell} words={words} />,
    },
    { ...paper, key: "paper value", cell: (cell) => printedValue(cell.paper_value, words.unit(cell.signal).scale) },
    { ...paper, key: "paper base", cell: (cell) => printedValue(cell.paper_base, words.unit(cell.signal).scale) },
    { ...paper, key: "paper change", cell: (cell) => <PrintedChange cell={cell} /> },
    { ...here, key: "our value", cell: (cell) => shown(cell.our_value, cell) },
    { ...here, key: "our base", cell: (cell) => shown(cell.our_base, cell) },
    { ...here, key: "our change", cell: (cell) => <OurChange item={cell} /> },
    {
      ...verdict,
      key: "verdict",
      head: "Verdict",
      headAttributes: { "data-own": true },
      attributes: () => ({ ...verdict.attributes(), "data-own": true }),
      cell: (cell) => <VerdictMark verdict={cell.verdict} certain={cell.certain} />,
    },
    {
      ...verdict,
      key: "without",
      head: (
        <>
          <Icon name="EyeOff" size={13} className={ui.inline} /> Without preview
        </>
      ),
      cell: ({ without_preview: without }) => <Without without={without} />,
    },
  ];
}

function Signal({ cell, words }: { readonly cell: PaperCell; readonly words: Labels }) {
  return (
    <>
      {words.signal(cell.signal)} <span className={ui.dim}>{words.unit(cell.signal).unit}</span>
      {/* Where the table is wider than the window, the verdict stands where it is in sight. */}
      <Box component="span" display="block" fz="xs" hiddenFrom="sm">
        <VerdictMark verdict={cell.verdict} certain={cell.certain} />
      </Box>
    </>
  );
}

function Without({ without }: { readonly without: PaperCell["without_preview"] }) {
  if (!without) return <span className={ui.under}>no preview in it</span>;
  return (
    <>
      <VerdictMark verdict={without.verdict} certain={without.certain} />
      {/* A line that is pending has its height. */}
      <span className={ui.under}>
        {without.our_change !== null && without.ci !== null
          ? `${formatPercent(without.our_change)} ${spreadOf(without.our_change, without.ci)}`
          : "\u00a0"}
      </span>
    </>
  );
}

function OurChange({ item: { our_change: change, ci } }: { readonly item: PaperJudgement }) {
  if (change === null || ci === null) return <>–</>;
  return (
    <>
      <b>{formatPercent(change)}</b> <span className={ui.dim}>{spreadOf(change, ci)}</span>
    </>
  );
}

function PrintedChange({ cell: { paper_change: printed, misprint } }: { readonly cell: PaperCell }) {
  if (!misprint) return <>{printedChange(printed)}</>;
  return (
    <>
      <Box component="s" c="dimmed">
        {printedChange(misprint.printed)}
      </Box>
      <Box component="span" display="block" maw="7.5rem" ml="auto" fz="xs" c="var(--worse)" style={WRAPPED}>
        <Icon name="AlertTriangle" size={12} className={ui.inline} /> misprint: {printedChange(misprint.follows)}{" "}
        follows
      </Box>
    </>
  );
}

const WRAPPED = { whiteSpace: "normal" } as const;
