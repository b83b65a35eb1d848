import { useEffect } from "react";
import { useStore } from "../lib/store";
import { plotlyState, requestCharts, requestPlotly, type Plotly } from "./plotly";

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
