/** plotly.js with lines and points: all that the lab's panels draw. */

export { default } from "plotly.js/lib/core";
