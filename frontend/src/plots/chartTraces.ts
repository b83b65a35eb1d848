/** What charts draw beside lines and points; the lab's panels do without. */

import plotly from "plotly.js/lib/core";
import bar from "plotly.js/lib/bar";
import contour from "plotly.js/lib/contour";
import heatmap from "plotly.js/lib/heatmap";

plotly.register([bar, heatmap, contour]);
