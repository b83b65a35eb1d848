/** Says over how many roads the numbers are, and which road the curves are of. */

import { Text } from "@mantine/core";
import type { Scene } from "../state/scene";
import { getAt } from "../editor/path";
import classes from "./shell.module.css";

export function RoadsNote({ scene: { shown, baseline, reference } }: { readonly scene: Scene }) {
  const { over, scenario } = shown;
  if (over === null) return null;
  const seed = getAt(scenario, "/road/seed");
  return (
    <Text size="xs" c="dimmed" className={classes.roadsNote ?? ""} data-testid="roads">
      Mean of {over.roads} roads ± 95 % interval{reference === null && over.baseline === baseline ? "; changes are paired, no arrow where the interval includes zero" : ""}. Curves and events: road seed{" "}
      {typeof seed === "number" ? seed : "?"}.
    </Text>
  );
}
