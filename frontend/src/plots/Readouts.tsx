/** The curves' values at the cursor, beside the panel's title. */

import type { FigureMeta, SeriesByStrategy, Strategy } from "../api/types";
import type { Axis } from "../state/address";
import { cursor } from "../state/cursor";
import { axisKey } from "../state/scene";
import { useStore } from "../state/store";
import { formatNumber } from "../units/format";
import classes from "./plots.module.css";
import { valueAt } from "./samples";

interface Props {
  readonly meta: FigureMeta;
  readonly series: SeriesByStrategy;
  readonly strategies: readonly Strategy[];
  readonly axis: Axis;
}

export function Readouts({ meta, series, strategies, axis }: Props) {
  const x = useStore(cursor);
  if (x === null) return null;
  return (
    <span className={classes.readouts} aria-hidden>
      {strategies.map(({ id, colour }) => {
        const samples = series[id]?.[axisKey(axis)];
        const values = series[id]?.[meta.signal];
        const value = samples && values ? valueAt(samples, values, x) : null;
        return (
          <span key={id} className={classes.readout}>
            <span className={classes.swatch} style={{ background: colour }} />
            {value === null ? "–" : formatNumber(value * meta.scale)}
          </span>
        );
      })}
    </span>
  );
}
