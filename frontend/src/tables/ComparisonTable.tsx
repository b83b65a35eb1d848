/** RMS on the rough road and peak on the bump, side by side, a row for each strategy of each variant. */

import type { Catalogue, FigureTemplate, SignalKey } from "../api/types";
import type { Scene } from "../state/scene";
import { prettyUnit } from "../units/format";
import { entryGroups } from "./entries";
import { EntryHead } from "./EntryHead";
import { ResultCell } from "./ResultCell";
import classes from "./tables.module.css";
import { shownUnit } from "./units";
import { SolveButton } from "../solve/SolveButton";
import { ScrollTable } from "../ui/ScrollTable";

export interface ComparisonProps {
  readonly scene: Scene;
  readonly catalogue: Catalogue;
  readonly figures: Readonly<Record<string, FigureTemplate>>;
  readonly signals: readonly SignalKey[];
}

export interface WindowView {
  readonly window: "rough_road" | "bump";
  readonly statistic: "rms" | "peak";
}

interface Props extends ComparisonProps {
  readonly caption: string;
}

/** The paper's two views of a run: which statistic over which window. */
export const VIEWS: readonly WindowView[] = [
  { window: "rough_road", statistic: "rms" },
  { window: "bump", statistic: "peak" },
];

export function headingOf({ window, statistic }: WindowView, catalogue: Catalogue): string {
  const name = (list: Catalogue["windows"], key: string) => list.find((entry) => entry.key === key)?.label ?? key;
  return `${name(catalogue.statistics, statistic)}, ${name(catalogue.windows, window).toLowerCase()}`;
}

export function ComparisonTable({ scene, catalogue, figures, signals, caption }: Props) {
  const groups = entryGroups(scene);
  const labels = Object.fromEntries(catalogue.signals.map(({ key, label }) => [key, label]));
  return (
    <ScrollTable label={caption} className={classes.table}>
      <caption className="visually-hidden">{caption}</caption>
      <thead>
        <tr>
          <td />
          {VIEWS.map((view) => (
            <th key={view.window} scope="colgroup" colSpan={signals.length} className={classes.group}>
              {headingOf(view, catalogue)}
            </th>
          ))}
        </tr>
        <tr>
          <th scope="col" className={classes.corner}>
            Strategy
          </th>
          {VIEWS.map(({ window, statistic }) =>
            signals.map((signal, index) => (
              <th key={`${window} ${signal}`} scope="col" className={classes.column} data-first={index === 0 || undefined}>
                <span className={classes.columnName}>{labels[signal] ?? signal}</span>
                <span className={classes.columnUnit}>
                  {prettyUnit(shownUnit(signal, figures, catalogue).unit)} <SolveButton metric={`${window}.${signal}.${statistic}`} label={`${labels[signal] ?? signal}, ${window.replace("_", " ")}`} />
                </span>
              </th>
            )),
          )}
        </tr>
      </thead>
      {groups.map(({ name, entries }) => (
        <tbody key={entries[0]?.key ?? name} data-pinned={name ?? undefined}>
          {groups.length > 1 && <GroupRow name={name} columns={1 + VIEWS.length * signals.length} />}
          {entries.map((entry) => (
            <tr key={entry.key} data-baseline={entry.isBaseline || undefined} {...{ [name === null ? "data-strategy" : "data-pinned-strategy"]: entry.strategy.id }}>
              <th scope="row" className={classes.rowHeader}>
                <EntryHead entry={entry} catalogue={catalogue} />
              </th>
              {VIEWS.map(({ window, statistic }) =>
                signals.map((signal, index) => (
                  <ResultCell
                    key={`${window} ${signal}`}
                    first={index === 0}
                    name={`${window}.${signal}.${statistic}`}
                    metric={{ window, signal, statistic }}
                    scale={shownUnit(signal, figures, catalogue).scale}
                    {...{ scene, entry }}
                  />
                )),
              )}
            </tr>
          ))}
        </tbody>
      ))}
    </ScrollTable>
  );
}

function GroupRow({ name, columns }: { readonly name: string | null; readonly columns: number }) {
  return (
    <tr>
      <th scope="rowgroup" colSpan={columns} className={classes.variantRow}>
        {name ?? "Current scenario"}
      </th>
    </tr>
  );
}
