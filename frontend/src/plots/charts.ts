/** plotly.js with all that the page draws by it. */

import plotly from "./bundle";
import bar from "plotly.js/lib/bar";
import contour from "plotly.js/lib/contour";
import heatmap from "plotly.js/lib/heatmap";

plotly.register([bar, heatmap, contour]);

export default plotly;
