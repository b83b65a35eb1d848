import { useEffect, useState } from "react";
import { loadPlotly, type Plotly } from "./plotly";

/** plotly.js, once it is loaded. */
export function usePlotly(): Plotly | null {
  const [plotly, setPlotly] = useState<{ readonly current: Plotly } | null>(null);
  useEffect(() => {
    let mounted = true;
    void loadPlotly().then((current) => {
      if (mounted) setPlotly({ current });
    });
    return () => {
      mounted = false;
    };
  }, []);
  return plotly?.current ?? null;
}
