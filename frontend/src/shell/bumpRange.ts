/** The bump with some road around it, on the shared axis. */

import type { Zoom } from "../state/address";
import type { Scene } from "../state/scene";

export function bumpRange({ strategies, summaries, axis, whole }: Scene): Zoom | null {
  const spans = strategies.flatMap(({ id }) => summaries[id]?.stages.find(({ stage }) => stage === "bump") ?? []);
  if (spans.length === 0) return null;
  const ends = spans.map((span) =>
    axis === "distance" ? [span.start_position, span.end_position] : [span.start_time, span.end_time],
  );
  const low = Math.min(...ends.map(([start = 0]) => start));
  const high = Math.max(...ends.map(([, end = 0]) => end));
  const around = 0.6 * (high - low);
  return [Math.max(whole[0], low - around), Math.min(whole[1], high + 1.5 * around)];
}
