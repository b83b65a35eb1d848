import { useEffect } from "react";
import { useStore } from "../state/store";
import { plotlyState, requestPlotly, type Plotly } from "./plotly";

/** plotly.js, once it is loaded; asked for when the browser has nothing else to do. */
export function usePlotly(): Plotly | null {
  const state = useStore(plotlyState);
  useEffect(() => {
    const idle = requestIdleCallback(requestPlotly, { timeout: LATEST_MS });
    return () => cancelIdleCallback(idle);
  }, []);
  return state.plotly;
}

const LATEST_MS = 1500;
