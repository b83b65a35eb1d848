/** LV in the ECU beside LV in the simulation: the paper's eight metrics and the rule for them. */

import { Anchor, Text } from "@mantine/core";
import { Link } from "@tanstack/react-router";
import { Icon } from "../../ui/icons";
import type { Catalogue, Strategy, Summary } from "../../api/types";
import { VIEWS } from "../../features/tables/entries";
import { ChangeMark } from "../../features/tables/ChangeMark";
import { formatPercent, changeAgainst } from "../../features/tables/change";
import { StrategyName, NameWithUnit } from "../../ui/StrategyKey";
import tables from "../../features/tables/tables.module.css";
import { formatResult, formatWhole, prettyUnit } from "../../units/format";
import classes from "./ecu.module.css";
import { DataTable, type Column } from "../../ui/DataTable";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";
import { Note } from "../../ui/Messages";
import { useLabels, type Labels } from "../../server/useCatalogues";

interface Props {
  readonly summaries: Readonly<Record<string, Summary>>;
  readonly strategies: readonly Strategy[];
  readonly stale: boolean;
}

export function EcuTable({ summaries, strategies, stale }: Props) {
  const words = useLabels();
  const rows = rowsOf(words.catalogue, summaries);
  const judged = rows.filter(({ within }) => within !== null);
  const reached = judged.filter(({ within }) => within).length;
  return (
    <Card
      className={classes.part}
      aria-label="LV in the ECU against LV in the simulation"
      data-stale={stale || undefined}
      title="ECU against simulation"
      tools={
        judged.length > 0 && (
          <Text fw={650} data-testid="hil-count" className={(reached === judged.length ? ui.good : ui.warning) ?? ""}>
            {reached} of {judged.length} within ±{RULE_PERCENT}&nbsp;%
          </Text>
        )
      }
    >
      <Text px="0.9rem" pb="sm" data-testid="hil-conclusion">
        {conclusionOf(rows, ({ signal, view }) => `${words.signal(signal)}, ${words.view(view)}`)}
      </Text>
      <DataTable
        label="Metrics, in the ECU and in the simulation"
        groups={VIEWS.map((view) => ({
          key: view.window,
          title: words.view(view),
          rows: rows.filter((row) => row.view === view),
        }))}
        rowKey={({ key }) => key}
        rowAttributes={({ key }) => ({ "data-cell": key })}
        columns={columnsOf(strategies, words)}
      />
      <Note className={ui.note ?? ""}>
        The rule of Tables 9 and 10: each change within ±{RULE_PERCENT}&nbsp;% of the simulation. Over many roads and
        beside what they print:{" "}
        <Anchor size="xs" underline="always" renderRoot={(props) => <Link to="/paper" {...props} />}>
          the paper page
        </Anchor>
        .
      </Note>
      <EcuEvents summary={summaries.lv_hil} catalogue={words.catalogue} />
    </Card>
  );
}

function columnsOf(strategies: readonly Strategy[], words: Labels): readonly Column<HilRow>[] {
  const valueOf = (row: HilRow, id: string) => ({ lv: row.lv, lv_hil: row.hil, lqr: row.lqr })[id];
  return [
    {
      key: "metric",
      head: "Metric",
      text: true,
      cell: ({ signal }) => <NameWithUnit name={words.signal(signal)} unit={words.unit(signal).unit} />,
    },
    ...strategies.map((strategy): Column<HilRow> => ({
      key: strategy.id,
      head: <StrategyName strategy={strategy} />,
      headAttributes: { style: { width: "19%" } },
      attributes: (row) => ({ "data-value": valueOf(row, strategy.id) ?? "" }),
      cell: (row) => (
        <>
          <span className={tables.value}>{formatShown(valueOf(row, strategy.id), words.unit(row.signal).scale)}</span>
          {strategy.id === "lv" ? (
            <span className={tables.change}>&nbsp;</span>
          ) : (
            <ChangeMark value={valueOf(row, strategy.id)} baseline={row.lv} />
          )}
        </>
      ),
    })),
    {
      key: "within",
      head: <>Within ±{RULE_PERCENT}&nbsp;%</>,
      attributes: ({ within }) => ({ "data-within": within ?? "" }),
      cell: (row) => <Verdict row={row} />,
    },
  ];
}

const formatShown = (value: number | undefined, scale: number) =>
  value === undefined ? "–" : formatResult(value * scale);

function Verdict({ row: { within, change } }: { readonly row: HilRow }) {
  if (within === null || change === null) return <span className={tables.change}>–</span>;
  return (
    <span className={within ? ui.good : ui.warning}>
      <Icon name={within ? "Check" : "AlertTriangle"} size={14} className={ui.inline} />{" "}
      {within ? "yes" : `no, ${formatPercent(change)}`}
    </span>
  );
}

/** Whole numbers stay whole. */
const shownEvent = (value: number | boolean | null | undefined) =>
  typeof value !== "number" ? String(value) : Number.isInteger(value) ? formatWhole(value) : formatResult(value);

/** What the loop itself met: held commands, unfinished iterations, clipped values. */
function EcuEvents({ summary, catalogue }: { readonly summary: Summary | undefined; readonly catalogue: Catalogue }) {
  const events = catalogue.events.filter(
    ({ key }) => key.startsWith("ecu_") && summary?.events[key] !== undefined && summary.events[key] !== null,
  );
  if (!summary || events.length === 0) return null;
  return (
    <dl className={`${ui.facts} ${ui.note}`} aria-label="What the loop met">
      {events.map(({ key, label, unit, description }) => (
        <div key={key} title={description}>
          <dt>{label}</dt>
          <dd>
            {shownEvent(summary.events[key])} {prettyUnit(unit)}
          </dd>
        </div>
      ))}
    </dl>
  );
}

/** What the ECU's code makes worse and better, and whether it still betters the LQR; empty while there is nothing to compare. */
export function conclusionOf(rows: readonly HilRow[], nameOf: (row: HilRow) => string): string {
  const compared = rows.filter(({ change }) => change !== null);
  if (compared.length === 0) return "";
  const change = ({ change: percent }: HilRow) => percent ?? 0;
  const sorted = compared.toSorted((a, b) => change(a) - change(b));
  const part = (verdict: "worse" | "better", most: HilRow | undefined) => {
    const number = compared.filter(({ hil, lv }) => changeAgainst(hil, lv).verdict === verdict).length;
    return `${verdict} in ${number}${number > 0 && most ? ` (${formatPercent(change(most))} at most: ${nameOf(most)})` : ""}`;
  };
  const ahead = compared.filter(({ hil, lqr }) => changeAgainst(hil, lqr).verdict === "better").length;
  return `Of ${compared.length} metrics the ECU’s code makes LV ${part("worse", sorted.at(-1))} and ${part("better", sorted[0])}; it is better than LQR in ${ahead}.`;
}

/** A change of at most so much [%] counts as reached: Tables 9 and 10 print +0.6 to +7.6. */
const RULE_PERCENT = 8;

interface HilRow {
  readonly key: string;
  readonly signal: string;
  readonly view: (typeof VIEWS)[number];
  readonly lv: number | undefined;
  readonly hil: number | undefined;
  readonly lqr: number | undefined;
  /** Of `lv_hil` against `lv` [%]. */
  readonly change: number | null;
  /** `null` where there is nothing to compare. */
  readonly within: boolean | null;
}

type Summaries = Readonly<Record<string, Summary>>;

export function rowsOf(catalogue: Pick<Catalogue, "paper_signals">, summaries: Summaries): readonly HilRow[] {
  return VIEWS.flatMap((view) =>
    catalogue.paper_signals.map((signal): HilRow => {
      const of = (strategy: string) =>
        summaries[strategy]?.metrics[view.window]?.[signal]?.[view.statistic] ?? undefined;
      const [lv, hil, lqr] = [of("lv"), of("lv_hil"), of("lqr")];
      const { percent } = changeAgainst(hil, lv);
      return {
        key: `${view.window}.${signal}.${view.statistic}`,
        signal,
        view,
        lv,
        hil,
        lqr,
        change: percent,
        within: percent === null ? null : Math.abs(percent) <= RULE_PERCENT,
      };
    }),
  );
}
