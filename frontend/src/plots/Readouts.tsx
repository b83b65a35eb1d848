/** The curves' values at the cursor, beside the panel's title. */

import { useMemo } from "react";
import type { FigureMeta, SeriesByStrategy, Strategy } from "../api/types";
import type { Axis } from "../lab/address";
import { useCursor } from "../lab/cursor";
import { axisKey } from "../lab/resultView";
import { formatFixed } from "../units/format";
import classes from "./plots.module.css";
import { extent, valueAt } from "../lib/samples";

interface Props {
  readonly meta: FigureMeta;
  readonly series: SeriesByStrategy;
  readonly strategies: readonly Strategy[];
  readonly axis: Axis;
}

/** As many decimals as give three digits to the run's largest value: the numbers keep their width while they change. */
function decimalsFor({ signal, scale }: FigureMeta, all: SeriesByStrategy): number {
  const ends = Object.values(all).flatMap((series) => (series[signal] ? (extent(series[signal]) ?? []) : []));
  const largest = Math.max(0, ...ends.map((value) => Math.abs(value * scale)));
  return largest > 0 ? Math.min(6, Math.max(0, 2 - Math.floor(Math.log10(largest)))) : 0;
}

export function Readouts({ meta, series, strategies, axis }: Props) {
  const x = useCursor(axis);
  const decimals = useMemo(() => decimalsFor(meta, series), [meta, series]);
  return (
    <span className={classes.readouts} data-empty={x === null || undefined} aria-hidden>
      {strategies.map(({ id, colour }) => {
        const samples = series[id]?.[axisKey(axis)];
        const values = series[id]?.[meta.signal];
        const value = x !== null && samples && values ? valueAt(samples, values, x) : null;
        return (
          <span key={id} className={classes.readout}>
            <span className={classes.swatch} style={{ background: colour }} />
            {value === null ? "–" : formatFixed(value * meta.scale, decimals)}
          </span>
        );
      })}
    </span>
  );
}
