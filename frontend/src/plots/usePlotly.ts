import { useEffect, useState } from "react";
import { loadPlotly, type Plotly } from "./plotly";

/** plotly.js, once it is loaded. */
export function usePlotly(): Plotly | null {
  const [plotly, setPlotly] = useState<{ readonly current: Plotly } | null>(null);
  useEffect(() => {
    let wanted = true;
    void loadPlotly().then((current) => {
      if (wanted) setPlotly({ current });
    });
    return () => {
      wanted = false;
    };
  }, []);
  return plotly?.current ?? null;
}
