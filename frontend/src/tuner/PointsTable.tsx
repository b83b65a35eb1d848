/** The best points beside the paper's weights: what they give on the training roads, and their weights. */

import { Button } from "@mantine/core";
import type { Tuning } from "../api/types";
import { ChangeMark } from "../tables/ChangeMark";
import tables from "../tables/tables.module.css";
import { dotted } from "../sweep/fields";
import { formatResult, prettyUnit } from "../units/format";
import type { Shown } from "./figures";
import type { Point } from "./points";
import { formatValue, singlesIn, weightAt, type Single, type Tunable } from "./space";
import results from "./results.module.css";
import type { Load } from "./useLoad";
import { ScrollTable } from "../ui/ScrollTable";
import { Card } from "../ui/Card";
import ui from "../ui/ui.module.css";

interface Props {
  readonly tuning: Tuning;
  readonly objectives: readonly Shown[];
  readonly limits: readonly Shown[];
  readonly tunable: Tunable;
  readonly points: readonly Point[];
  readonly load: Load;
}

export function PointsTable({ tuning, objectives, limits, tunable, points, load }: Props) {
  const singles = singlesIn(tunable, points[0]?.trial.weights ?? {});
  return (
    <Card aria-label="Best points" title="Best points, on the training roads">
      <ScrollTable label="Best points and their weights" className={results.points}>
        <thead>
          <tr>
            <td />
            {points.map(({ trial, names }) => (
              <th key={trial.number} scope="col" data-trial={trial.number}>
                <span className={results.pointName}>{names.join(", ")}</span>
                <span className={ui.dim}>trial {trial.number}</span>
                <Button size="compact-xs" variant="default" loading={load.loading === trial.number} aria-label={`Load in lab: ${names.join(", ")}`} onClick={() => load.load(trial)}>
                  Load in lab
                </Button>
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {objectives.map(({ label, unit, scale }, index) => (
            <tr key={label}>
              <Name label={label} unit={unit} />
              {points.map(({ trial, isPaper }) => (
                <td key={trial.number} className={tables.cell} data-cell={`objectives.${index}`} data-value={trial.values?.[index] ?? ""}>
                  <span className={tables.value}>{trial.values ? formatResult((trial.values[index] ?? NaN) * scale, 4) : "–"}</span>
                  {isPaper ? <span className={tables.change}>&nbsp;</span> : <ChangeMark value={trial.values?.[index]} baseline={tuning.paper?.values?.[index]} />}
                </td>
              ))}
            </tr>
          ))}
          {limits.map(({ label, unit, scale }, index) => (
            <tr key={`limit ${label}`}>
              <Name label={`${label}, largest`} unit={unit} />
              {points.map(({ trial }) => {
                const value = trial.limits?.[index];
                const over = value !== undefined && value > (tuning.limits[index]?.at_most ?? Infinity);
                return (
                  <td key={trial.number} className={`${tables.cell ?? ""} ${over ? (ui.error ?? "") : ""}`}>
                    <span className={tables.value}>{value === undefined ? "–" : formatResult(value * scale)}</span>
                    <span className={tables.change}>{over ? "over the limit" : "\u00a0"}</span>
                  </td>
                );
              })}
            </tr>
          ))}
          {tunable.triples.map(({ pointer, title, items }) => (
            <tr key={pointer} className={results.weightsRow}>
              <Name label={title} unit={items.map((item) => item.title.toLowerCase()).join(" · ")} />
              {points.map(({ trial }) => (
                <td key={trial.number} className={tables.cell} data-weights={dotted(pointer)}>
                  {items.map((item) => shownWeight(weightAt(trial.weights, dotted(item.pointer)), item)).join(" · ")}
                </td>
              ))}
            </tr>
          ))}
          {singles.map(({ name, title, field }) => (
            <tr key={name} className={results.weightsRow}>
              <Name label={title} unit="1" />
              {points.map(({ trial }) => (
                <td key={trial.number} className={tables.cell}>
                  {shownWeight(weightAt(trial.weights, name), field)}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </ScrollTable>
    </Card>
  );
}

const shownWeight = (value: number | string | undefined, field: Single["field"]) => (value === undefined ? "–" : formatValue(value, field));

function Name({ label, unit }: { readonly label: string; readonly unit: string }) {
  return (
    <th scope="row" className={tables.quantity}>
      {label} <span className={ui.dim}>{prettyUnit(unit)}</span>
    </th>
  );
}
