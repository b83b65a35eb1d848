/** Says that plotly.js could not be loaded, and tries again. */

import { Button } from "@mantine/core";
import { useStore } from "../lib/store";
import { Fault } from "../ui/Fault";
import { plotlyState, requestCharts } from "./plotly";

export function PlotlyFault() {
  const { failed } = useStore(plotlyState);
  if (!failed) return null;
  return (
    <Fault size="sm">
      The plot library could not be loaded.{" "}
      <Button size="compact-xs" variant="light" onClick={requestCharts}>
        Try again
      </Button>
    </Fault>
  );
}
