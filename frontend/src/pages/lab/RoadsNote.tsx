/** Says over how many roads the numbers and the curves are, and which road the rest is of. */

import { Text } from "@mantine/core";
import { getAt } from "../../scenario/path";
import { useCurves } from "../../plots/useDetail";
import { useLab } from "../../lab/context";
import type { Scene } from "../../lab/resultView";

export function RoadsNote({ scene }: { readonly scene: Scene }) {
  const { shown, differences } = scene;
  const { over, scenario, source } = shown;
  const roads = useLab((state) => state.roads);
  const hasMeans = useCurves(scene).roads !== undefined;
  const seed = getAt(scenario, "/road/seed");
  const first = `road seed ${typeof seed === "number" ? seed : "?"}`;
  if (over === null && (source === "exact" || roads === 1)) return null;
  return (
    <Text size="xs" c="dimmed" m="0 0 0.5rem 0.2rem" data-testid="roads">
      {over === null ? (
        `While a value is dragged: ${first} only; then the mean of ${roads} roads.`
      ) : (
        <>
          Mean of {over.roads} roads ± 95 % interval.{" "}
          {hasMeans
            ? `Curves: ${differences ? "differences of the means" : "mean and range"}. Car, road and events: ${first}.`
            : `Curves, car and events are of the first road only, ${first}; the table is of all roads.`}
        </>
      )}
    </Text>
  );
}
