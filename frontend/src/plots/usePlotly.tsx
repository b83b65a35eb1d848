/** Says that plotly.js could not be loaded, and tries again. */

import { Button } from "@mantine/core";
import { useEffect } from "react";
import { useSelector } from "@tanstack/react-store";
import { Fault } from "../ui/Fault";
import { plotlyState, requestPlotly, type Plotly } from "./plotly";

export function PlotlyFault() {
  const { failed } = useSelector(plotlyState);
  if (!failed) return null;
  return (
    <Fault size="md">
      The plot library could not be loaded.{" "}
      <Button size="compact-xs" variant="light" onClick={requestPlotly}>
        Try again
      </Button>
    </Fault>
  );
}

/** plotly.js, asked for where something is drawn by it; `null` until it is there. */
export function usePlotly(): Plotly | null {
  useEffect(requestPlotly, []);
  return useSelector(plotlyState).plotly;
}
