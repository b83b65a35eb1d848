/** One number of the comparison, with its interval over several roads and its change. */

import type { Scene } from "../../lab/resultView";
import { ChangeText } from "./ChangeMark";
import { changeOf, type Entry } from "./entries";
import { Estimated } from "./Estimated";
import { intervalAt, valueAt, type MetricPath, type WindowMetric } from "./metric";

interface Props {
  readonly scene: Scene;
  readonly entry: Entry;
  readonly metric: MetricPath;
  /** From SI to the unit shown. */
  readonly scale: number;
}

export function ResultCell({ scene, entry, metric, scale }: Props) {
  return (
    <>
      <Estimated
        value={valueAt(entry.summary, metric)}
        interval={intervalAt(entry.shown, entry.strategy.id, metric)}
        scale={scale}
      />
      <ChangeText change={changeOf(scene, entry, metric, scale)} />
    </>
  );
}

/** What a cell is called and its unrounded value, for whoever looks for it. */
export const cellAttributes = ({ summary }: Entry, metric: WindowMetric) => ({
  "data-cell": `${metric.window}.${metric.signal}.${metric.statistic}`,
  "data-value": valueAt(summary, metric) ?? "",
});
