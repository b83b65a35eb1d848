/** plotly.js with lines and points: all that the figures of reports draw. */

export { default } from "plotly.js/lib/core";
