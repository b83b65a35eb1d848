/** LV in the ECU beside LV in the simulation: the paper's eight figures and the rule for them. */

import { Anchor, Text } from "@mantine/core";
import { Link } from "@tanstack/react-router";
import { IconAlertTriangle, IconCheck } from "../icons";
import type { Catalogue, FigureTemplate, Strategy, Summary } from "../api/types";
import { headingOf, VIEWS } from "../tables/ComparisonTable";
import { ChangeMark } from "../tables/ChangeMark";
import { formatPercent } from "../tables/change";
import { StrategyKey } from "../tables/StrategyKey";
import tables from "../tables/tables.module.css";
import { shownUnit } from "../tables/units";
import { formatResult, formatWhole, prettyUnit } from "../units/format";
import classes from "./hil.module.css";
import { rowsOf, RULE_PERCENT, type HilRow } from "./rule";
import { ScrollTable } from "../ui/ScrollTable";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

interface Props {
  readonly summaries: Readonly<Record<string, Summary>>;
  readonly strategies: readonly Strategy[];
  readonly catalogue: Catalogue;
  readonly figures: Readonly<Record<string, FigureTemplate>>;
  readonly stale: boolean;
}

export function EcuTable({ summaries, strategies, catalogue, figures, stale }: Props) {
  const rows = rowsOf(catalogue, summaries);
  const judged = rows.filter(({ within }) => within !== null);
  const reached = judged.filter(({ within }) => within).length;
  return (
    <Card
      aria-label="LV in the ECU against LV in the simulation"
      data-stale={stale || undefined}
      title="ECU against simulation"
      tools={
        <>
          {judged.length > 0 && (
            <Text size="sm" fw={650} data-testid="hil-count" className={reached === judged.length ? classes.good : classes.bad}>
              {reached} of {judged.length} within ±{RULE_PERCENT}&nbsp;%
            </Text>
          )}
        </>
      }
    >
      <ScrollTable label="Figures, in the ECU and in the simulation" className={classes.table}>
        <thead>
          <tr>
            <th scope="col" className={tables.corner}>
              Figure
            </th>
            {strategies.map((strategy) => (
              <th key={strategy.id} scope="col" className={tables.column}>
                <span className={classes.columnHead}>
                  <StrategyKey strategy={strategy} /> {strategy.label}
                </span>
              </th>
            ))}
            <th scope="col" className={tables.column}>
              Within ±{RULE_PERCENT}&nbsp;%
            </th>
          </tr>
        </thead>
        {VIEWS.map((view) => (
          <tbody key={view.window}>
            <tr className={classes.groupRow}>
              <th scope="colgroup" colSpan={strategies.length + 2} className={tables.group}>
                {headingOf(view, catalogue)}
              </th>
            </tr>
            {rows
              .filter((row) => row.view === view)
              .map((row) => (
                <Row key={row.key} row={row} {...{ strategies, catalogue }} unit={shownUnit(row.signal, figures, catalogue)} />
              ))}
          </tbody>
        ))}
      </ScrollTable>
      <Text size="xs" c="dimmed" className={classes.foot ?? ""}>
        The rule of Tables 9 and 10: each change within ±{RULE_PERCENT}&nbsp;% of the simulation. Over many roads and beside what they print: <Anchor size="xs" underline="always" renderRoot={(props) => <Link to="/paper" {...props} />}>the paper page</Anchor>.
      </Text>
      <EcuEvents summary={summaries.lv_hil} catalogue={catalogue} />
    </Card>
  );
}

interface RowProps {
  readonly row: HilRow;
  readonly strategies: readonly Strategy[];
  readonly catalogue: Catalogue;
  readonly unit: { readonly unit: string; readonly scale: number };
}

function Row({ row, strategies, catalogue, unit: { unit, scale } }: RowProps) {
  const values: Readonly<Record<string, number | undefined>> = { lv: row.lv, lv_hil: row.hil, lqr: row.lqr };
  return (
    <tr data-cell={row.key}>
      <th scope="row" className={tables.quantity}>
        {catalogue.signals.find(({ key }) => key === row.signal)?.label ?? row.signal}
        <span className={ui.dim}> {prettyUnit(unit)}</span>
      </th>
      {strategies.map(({ id }) => (
        <td key={id} className={tables.cell} data-value={values[id] ?? ""}>
          <span className={tables.value}>{formatShown(values[id], scale)}</span>
          {id === "lv" ? <span className={tables.change}>&nbsp;</span> : <ChangeMark value={values[id]} baseline={row.lv} />}
        </td>
      ))}
      <td className={tables.cell} data-within={row.within ?? ""}>
        <Verdict row={row} />
      </td>
    </tr>
  );
}

const formatShown = (value: number | undefined, scale: number) => (value === undefined ? "–" : formatResult(value * scale));

function Verdict({ row: { within, change } }: { readonly row: HilRow }) {
  if (within === null || change === null) return <span className={tables.change}>–</span>;
  const Icon = within ? IconCheck : IconAlertTriangle;
  return (
    <span className={within ? classes.good : classes.bad}>
      <Icon size={14} stroke={2} aria-hidden className={classes.icon} /> {within ? "yes" : `no, ${formatPercent(change)}`}
    </span>
  );
}

/** Whole numbers stay whole. */
const shownEvent = (value: number | boolean | null | undefined) => (typeof value !== "number" ? String(value) : Number.isInteger(value) ? formatWhole(value) : formatResult(value));

/** What the loop itself met: held commands, unfinished iterations, clipped values. */
function EcuEvents({ summary, catalogue }: { readonly summary: Summary | undefined; readonly catalogue: Catalogue }) {
  const events = catalogue.events.filter(({ key }) => key.startsWith("ecu_") && summary?.events[key] !== undefined && summary.events[key] !== null);
  if (!summary || events.length === 0) return null;
  return (
    <dl className={classes.events} aria-label="What the loop met">
      {events.map(({ key, label, unit, description }) => (
        <div key={key} title={description} data-event={key}>
          <dt>{label}</dt>
          <dd>
            {shownEvent(summary.events[key])} {prettyUnit(unit)}
          </dd>
        </div>
      ))}
    </dl>
  );
}
