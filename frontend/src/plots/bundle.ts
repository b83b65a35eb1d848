/** plotly.js with lines and points: all that the lab's panels draw. */

import plotly from "plotly.js/lib/core";
import type { Plotly } from "./plotly";

export default plotly as unknown as Plotly; // its own types leave out what we freeze
