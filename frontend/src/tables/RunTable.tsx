/** Comfort, travel time and events: a row per figure, a column per strategy. */

import type { Catalogue, Quantity, Summary } from "../api/types";
import type { Scene } from "../state/scene";
import { formatNumber, formatResult, prettyUnit } from "../units/format";
import { ChangeMark } from "./ChangeMark";
import { Estimated } from "./Estimated";
import { statisticsOf } from "./overRoads";
import { StrategyKey } from "./StrategyKey";
import classes from "./tables.module.css";
import { ScrollTable } from "../ui/ScrollTable";

type Value = number | boolean | null | undefined;

interface Row {
  readonly quantity: Quantity;
  readonly read: (summary: Summary) => Value;
  /** Lower is better, so that a change has a verdict. */
  readonly judged: boolean;
}

function rows(catalogue: Catalogue): readonly Row[] {
  const runFigure = (key: string) => (summary: Summary) => (key === "travel_time" ? summary.travel_time : summary.arrival_speed_kmh);
  return [
    ...catalogue.comfort.map((quantity) => ({ quantity, read: (summary: Summary) => summary.comfort[quantity.key], judged: true })),
    ...catalogue.run_figures.map((quantity) => ({ quantity, read: runFigure(quantity.key), judged: quantity.key === "travel_time" })),
    ...catalogue.events.map((quantity) => ({ quantity, read: (summary: Summary) => summary.events[quantity.key], judged: false })),
  ];
}

function show(value: Value): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value !== "number") return "–";
  return Number.isInteger(value) ? formatNumber(value, Math.max(1, String(Math.abs(value)).length)) : formatResult(value);
}

export function RunTable({ scene, catalogue }: { readonly scene: Scene; readonly catalogue: Catalogue }) {
  const reference = scene.baseline === null ? undefined : scene.summaries[scene.baseline];
  return (
    <ScrollTable label="Comfort, time and events" className={classes.runTable}>
      <caption className="visually-hidden">Comfort, time and events</caption>
      <thead>
        <tr>
          <th scope="col" className={classes.corner}>
            Comfort, time and events
          </th>
          {scene.strategies.map((strategy) => (
            <th key={strategy.id} scope="col" className={classes.column}>
              <span className={classes.columnName}>
                <StrategyKey strategy={strategy} /> {strategy.label}
              </span>
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows(catalogue).map(({ quantity, read, judged }) => (
          <tr key={quantity.key}>
            <th scope="row" className={classes.quantity} title={quantity.description}>
              {quantity.label} <span className={classes.columnUnit}>{prettyUnit(quantity.unit)}</span>
            </th>
            {scene.strategies.map(({ id }) => {
              const summary = scene.summaries[id];
              const value = summary && read(summary);
              const base = reference && read(reference);
              const overRoads = statisticsOf(scene, id, { comfort: quantity.key });
              return (
                <td key={id} className={classes.cell} data-cell={`${id}.${quantity.key}`}>
                  {overRoads.interval ? (
                    <Estimated value={overRoads.interval.mean} interval={overRoads.interval} scale={1} />
                  ) : (
                    <span className={classes.value}>{show(value)}</span>
                  )}
                  {judged && id !== scene.baseline && typeof value === "number" && typeof base === "number" && (
                    <ChangeMark value={value} baseline={base} paired={overRoads.change} />
                  )}
                </td>
              );
            })}
          </tr>
        ))}
      </tbody>
    </ScrollTable>
  );
}
