/** The comparison where there is little width: a row per signal, a column per strategy. */

import type { Quantity, SignalKey } from "../api/types";
import { prettyUnit } from "../units/format";
import { BaselineButton } from "./BaselineButton";
import { ChangeMark } from "./ChangeMark";
import type { ComparisonProps, WindowView } from "./ComparisonTable";
import { CaveatMarks } from "./CaveatMarks";
import { caveatsOf } from "./caveats";
import { Estimated } from "./Estimated";
import { statisticsOf } from "./overRoads";
import classes from "./tables.module.css";
import { shownUnit } from "./units";
import { ScrollTable } from "../ui/ScrollTable";

interface Props extends ComparisonProps {
  readonly view: WindowView;
  readonly heading: string;
}

export function NarrowTable({ scene, catalogue, figures, signals, view: { window, statistic }, heading }: Props) {
  const quantity = (signal: SignalKey): Quantity | undefined => catalogue.signals.find(({ key }) => key === signal);
  const valueOf = (strategy: string, signal: SignalKey) => scene.summaries[strategy]?.metrics[window]?.[signal]?.[statistic];
  return (
    <ScrollTable label={heading} className={classes.table}>
      <caption className={classes.narrowCaption}>{heading}</caption>
      <thead>
        <tr>
          <td />
          {scene.strategies.map((strategy) => (
            <th key={strategy.id} scope="col" className={classes.narrowColumn}>
              <BaselineButton strategy={strategy} isBaseline={strategy.id === scene.baseline} upright />
              <CaveatMarks caveats={caveatsOf(scene.summaries[strategy.id]?.events, catalogue)} upright />
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {signals.map((signal) => {
          const { unit, scale } = shownUnit(signal, figures, catalogue);
          return (
            <tr key={signal}>
              <th scope="row" className={classes.quantity}>
                {quantity(signal)?.label ?? signal} <span className={classes.columnUnit}>{prettyUnit(unit)}</span>
              </th>
              {scene.strategies.map(({ id }) => {
                const value = valueOf(id, signal);
                const overRoads = statisticsOf(scene, id, { window, signal, statistic });
                return (
                  <td key={id} className={classes.cell} data-baseline={id === scene.baseline || undefined} data-value={value ?? ""}>
                    <Estimated value={value} interval={overRoads.interval} scale={scale} />
                    {id === scene.baseline ? (
                      <span className={classes.change}>&nbsp;</span>
                    ) : (
                      <ChangeMark value={value} baseline={scene.baseline === null ? null : valueOf(scene.baseline, signal)} paired={overRoads.change} scale={scale} />
                    )}
                  </td>
                );
              })}
            </tr>
          );
        })}
      </tbody>
    </ScrollTable>
  );
}
