/** The paper's comparing tables, each with ours beside it: what it prints, what comes out here, the verdict. */

import { Anchor, Text } from "@mantine/core";
import { IconAlertTriangle, IconEyeOff } from "../icons";
import type { Paper, PaperCell, PaperJudgement, PaperTable } from "../api/types";
import { formatPercent } from "../tables/change";
import { formatResult } from "../units/format";
import { printedChange, printedValue, spreadOf, typeset } from "./numbers";
import classes from "./paper.module.css";
import tables from "./tables.module.css";
import { VerdictMark } from "./Verdict";
import { cellId } from "./verdicts";
import type { Words } from "./words";
import { ScrollTable } from "../ui/ScrollTable";

interface Props {
  readonly paper: Paper;
  readonly words: Words;
}

export function Tables({ paper, words }: Props) {
  return (
    <>
      <Text className={classes.text}>
        The paper’s columns are as printed; ours are means over {paper.seeds} roads, changes with their 95 % interval in percentage points. A{" "}
        <span className={tables.misprintWord}>misprint</span> is a printed change that does not follow from the absolutes printed beside it; the verdict is taken
        against the one that does. The absolutes are not the measure: the parameters the paper prints do not give its own passive car (
        <Anchor href="#errata" size="sm">
          errata
        </Anchor>
        ). Tables 1–3 and 6 are inputs: the fuzzy rules, the vehicle and the weights are in the{" "}
        <Anchor href="#count" size="sm">
          scenario
        </Anchor>
        .
      </Text>
      {paper.tables.map((table) => (
        <Table key={table.number} table={table} cells={paper.cells.filter((cell) => cell.table === table.number)} words={words} reason={paper.unavailable?.reason} />
      ))}
    </>
  );
}

interface TableProps {
  readonly table: PaperTable;
  readonly cells: readonly PaperCell[];
  readonly words: Words;
  /** Why cells are not available, where there are such. */
  readonly reason: string | undefined;
}

function Table({ table, cells, words, reason }: TableProps) {
  const [first] = cells;
  return (
    <div className={tables.tableBlock} id={`table-${table.number}`}>
      <h3 className={classes.subtitle}>
        Table {table.number} <span className={tables.subtitleRest}>{table.title}</span>
      </h3>
      <ScrollTable label={`Table ${table.number}`} card className={`${tables.table ?? ""} ${tables.comparison ?? ""}`} data-table={table.number}>
        <caption className="visually-hidden">{table.title}</caption>
        <thead>
          <tr>
            <th scope="col" className={tables.sticky}>
              {first ? words.view(first) : ""}
            </th>
            <th scope="colgroup" colSpan={3} className={tables.group}>
              Paper
            </th>
            <th scope="colgroup" colSpan={3} className={tables.group}>
              Here
            </th>
            <th scope="col" className={tables.group} data-own>
              Verdict
            </th>
            <th scope="col" className={tables.group}>
              <IconEyeOff size={13} stroke={2} aria-hidden className={tables.inlineIcon} /> Without preview
            </th>
          </tr>
        </thead>
        {table.columns.map(({ strategy, against }) => (
          <Pair
            key={`${strategy} ${against}`}
            strategy={words.strategy(strategy)}
            against={words.strategy(against)}
            cells={cells.filter((cell) => cell.strategy === strategy && cell.against === against)}
            words={words}
            reason={reason}
          />
        ))}
      </ScrollTable>
    </div>
  );
}

interface PairProps {
  readonly strategy: string;
  readonly against: string;
  readonly cells: readonly PaperCell[];
  readonly words: Words;
  readonly reason: string | undefined;
}

function Pair({ strategy, against, cells, words, reason }: PairProps) {
  const columns = [strategy, against, "Change"];
  return (
    <tbody>
      <tr className={tables.pair}>
        <th scope="rowgroup" className={tables.sticky}>
          {strategy}
          <span className={tables.against}>against {against}</span>
        </th>
        {["paper", "here"].map((side) =>
          columns.map((name, index) => (
            <th key={`${side} ${name}`} scope="col" className={tables.number} data-first={index === 0 || undefined}>
              {name}
            </th>
          )),
        )}
        <td className={tables.verdictCell} data-own />
        <td className={tables.verdictCell} />
      </tr>
      {cells.map((cell) => (
        <Row key={cell.signal} cell={cell} words={words} />
      ))}
      {reason !== undefined && cells.some(({ verdict }) => verdict === "unavailable") && (
        <tr>
          <td className={tables.notHere} colSpan={9}>
            <span>{typeset(reason)}.</span>
          </td>
        </tr>
      )}
    </tbody>
  );
}

function Row({ cell, words }: { readonly cell: PaperCell; readonly words: Words }) {
  const { unit, scale } = words.unit(cell.signal);
  const without = cell.without_preview;
  return (
    <tr id={cellId(cell)} data-verdict={cell.verdict}>
      <th scope="row" className={tables.sticky}>
        {words.signal(cell.signal)} <span className={tables.unit}>{unit}</span>
        {/* Where the table is wider than the window, the verdict stands where it is in sight. */}
        <span className={tables.nearVerdict}>
          <VerdictMark verdict={cell.verdict} certain={cell.certain} />
        </span>
      </th>
      <td className={tables.number} data-first>
        {printedValue(cell.paper_value, scale)}
      </td>
      <td className={tables.number}>{printedValue(cell.paper_base, scale)}</td>
      <td className={tables.number}>
        <PrintedChange cell={cell} />
      </td>
      <td className={tables.number} data-first>
        {cell.our_value === null ? "–" : formatResult(cell.our_value * scale)}
      </td>
      <td className={tables.number}>{cell.our_base === null ? "–" : formatResult(cell.our_base * scale)}</td>
      <td className={tables.number}>
        <OurChange item={cell} />
      </td>
      <td className={tables.verdictCell} data-own>
        <VerdictMark verdict={cell.verdict} certain={cell.certain} />
      </td>
      <td className={tables.verdictCell} data-without>
        {without ? (
          <span className={tables.without}>
            <VerdictMark verdict={without.verdict} certain={without.certain} />
            {/* A line that is pending has its height. */}
            <span className={tables.spread}>
              {without.our_change !== null && without.ci !== null ? `${formatPercent(without.our_change)} ${spreadOf(without.our_change, without.ci)}` : "\u00a0"}
            </span>
          </span>
        ) : (
          <span className={tables.spread}>no preview in it</span>
        )}
      </td>
    </tr>
  );
}

function OurChange({ item: { our_change: change, ci } }: { readonly item: PaperJudgement }) {
  if (change === null || ci === null) return <>–</>;
  return (
    <>
      <b>{formatPercent(change)}</b> <span className={tables.spread}>{spreadOf(change, ci)}</span>
    </>
  );
}

function PrintedChange({ cell: { paper_change: printed, misprint } }: { readonly cell: PaperCell }) {
  if (!misprint) return <>{printedChange(printed)}</>;
  return (
    <span className={tables.misprint}>
      <s>{printedChange(misprint.printed)}</s>
      <span className={tables.misprintMark}>
        <IconAlertTriangle size={12} stroke={2} aria-hidden className={tables.inlineIcon} /> misprint: {printedChange(misprint.follows)} follows
      </span>
    </span>
  );
}
