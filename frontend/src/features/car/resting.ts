/** Where the car stands until somebody moves the cursor: on its way up the bump. */

import { stagedStrategy } from "../../plots/shapes";
import type { Scene } from "../../lab/resultView";

export function restingCursor(scene: Scene): number {
  const id = stagedStrategy(scene.summaries, scene.ids);
  const bump = id === undefined ? undefined : scene.summaries[id]?.stages.find(({ stage }) => stage === "bump");
  if (!bump) return scene.range[0];
  const [from, to] =
    scene.axis === "distance" ? [bump.start_position, bump.end_position] : [bump.start_time, bump.end_time];
  return from + 0.22 * (to - from);
}
