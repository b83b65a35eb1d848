/** RMS on the rough road and peak on the bump, side by side, against a baseline chosen by a click. */

import type { Catalogue, FigureTemplate, SignalKey } from "../api/types";
import type { Scene } from "../state/scene";
import { prettyUnit } from "../units/format";
import { BaselineButton } from "./BaselineButton";
import { ChangeMark } from "./ChangeMark";
import { CaveatMarks } from "./CaveatMarks";
import { caveatsOf } from "./caveats";
import { Estimated } from "./Estimated";
import { statisticsOf, type RoadsStatistics } from "./overRoads";
import classes from "./tables.module.css";
import { shownUnit } from "./units";
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
          {VIEWS.map(({ window }) =>
            signals.map((signal, index) => (
              <th key={`${window} ${signal}`} scope="col" className={classes.column} data-first={index === 0 || undefined}>
                <span className={classes.columnName}>{labels[signal] ?? signal}</span>
                <span className={classes.columnUnit}>{prettyUnit(shownUnit(signal, figures, catalogue).unit)}</span>
              </th>
            )),
          )}
        </tr>
      </thead>
      <tbody>
        {scene.strategies.map((strategy) => (
          <tr key={strategy.id} data-baseline={strategy.id === scene.baseline || undefined} data-strategy={strategy.id}>
            <th scope="row" className={classes.rowHeader}>
              <BaselineButton strategy={strategy} isBaseline={strategy.id === scene.baseline} />
              <CaveatMarks caveats={caveatsOf(scene.summaries[strategy.id]?.events, catalogue)} />
            </th>
            {VIEWS.map(({ window, statistic }) =>
              signals.map((signal, index) => (
                <Cell
                  key={`${window} ${signal}`}
                  first={index === 0}
                  name={`${window}.${signal}.${statistic}`}
                  value={scene.summaries[strategy.id]?.metrics[window]?.[signal]?.[statistic]}
                  baseline={scene.baseline === null ? null : scene.summaries[scene.baseline]?.metrics[window]?.[signal]?.[statistic]}
                  overRoads={statisticsOf(scene, strategy.id, { window, signal, statistic })}
                  isBaseline={strategy.id === scene.baseline}
                  scale={shownUnit(signal, figures, catalogue).scale}
                />
              )),
            )}
          </tr>
        ))}
      </tbody>
    </ScrollTable>
  );
}

interface CellProps {
  readonly name: string;
  readonly first: boolean;
  readonly value: number | null | undefined;
  readonly baseline: number | null | undefined;
  readonly overRoads: RoadsStatistics;
  readonly isBaseline: boolean;
  readonly scale: number;
}

function Cell({ name, first, value, baseline, overRoads, isBaseline, scale }: CellProps) {
  return (
    <td className={classes.cell} data-first={first || undefined} data-cell={name} data-value={value ?? ""}>
      <Estimated value={value} interval={overRoads.interval} scale={scale} />
      {isBaseline ? <span className={classes.change}>&nbsp;</span> : <ChangeMark value={value} baseline={baseline} paired={overRoads.change} scale={scale} />}
    </td>
  );
}
