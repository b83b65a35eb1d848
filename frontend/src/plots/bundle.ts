/** plotly.js with the traces this page uses, and no others. */

import plotly from "plotly.js/lib/core";
import bar from "plotly.js/lib/bar";
import contour from "plotly.js/lib/contour";
import heatmap from "plotly.js/lib/heatmap";
import type { Plotly } from "./plotly";

plotly.register([bar, heatmap, contour]); // lines and points are in the core

export default plotly as unknown as Plotly; // its own types leave out what we freeze
