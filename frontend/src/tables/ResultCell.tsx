/** One number of the comparison, with its interval over several roads and its change. */

import type { Scene } from "../state/scene";
import { ChangeText } from "./ChangeMark";
import { changeOf, type Entry } from "./entries";
import { Estimated } from "./Estimated";
import { intervalAt, valueAt, type MetricPath } from "./metric";
import classes from "./tables.module.css";

interface Props {
  readonly scene: Scene;
  readonly entry: Entry;
  readonly metric: MetricPath;
  /** What the cell is called, for whoever looks for it. */
  readonly name: string;
  /** From SI to the unit shown. */
  readonly scale: number;
  readonly first?: boolean;
  /** For a table whose columns are the strategies. */
  readonly marked?: boolean;
}

export function ResultCell({ scene, entry, metric, name, scale, first = false, marked = false }: Props) {
  const value = valueAt(entry.summary, metric);
  return (
    <td
      className={classes.cell}
      data-first={first || undefined}
      data-baseline={(marked && entry.isBaseline) || undefined}
      data-cell={name}
      data-value={value ?? ""}
    >
      <Estimated value={value} interval={intervalAt(entry.shown, entry.strategy.id, metric)} scale={scale} />
      <ChangeText change={changeOf(scene, entry, metric, scale)} />
    </td>
  );
}
