/** Says that plotly.js could not be loaded, and tries again. */

import { Button } from "@mantine/core";
import { useEffect } from "react";
import { useStore } from "../lib/store";
import { Fault } from "../ui/Fault";
import { plotlyState, requestCharts, requestPlotly, type Plotly } from "./plotly";

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

/** plotly.js, once it is loaded; asked for when the browser has nothing else to do. */
export function usePlotly(): Plotly | null {
  const state = useStore(plotlyState);
  useEffect(() => {
    const idle = requestIdleCallback(requestPlotly, { timeout: LATEST_MS });
    return () => cancelIdleCallback(idle);
  }, []);
  return state.plotly;
}

/** The same with every trace that charts draw. */
export function useCharts(): Plotly | null {
  const state = useStore(plotlyState);
  useEffect(requestCharts, []);
  return state.hasCharts ? state.plotly : null;
}

const LATEST_MS = 1500;
