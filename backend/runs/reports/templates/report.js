
"use strict";
(() => {
  const CONFIG = { displayModeBar: false, responsive: false, doubleClick: "reset" };
  const PALETTES = {
    light: { text: "#4a555b", grid: "rgba(120, 135, 142, 0.2)", zero: "rgba(120, 135, 142, 0.55)", hover: "#ffffff" },
    dark: { text: "#a9b3b9", grid: "rgba(140, 150, 156, 0.2)", zero: "rgba(140, 150, 156, 0.5)", hover: "#26292d" },
  };
  const PAPER = { width: 655, height: 200 }; // what is printed of an A4 page, and of Letter [px]
  const figures = JSON.parse(document.getElementById("figures").textContent);
  const plots = [...document.querySelectorAll("[data-figure]")];
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const coarse = matchMedia("(pointer: coarse)");
  let printing = false;

  function axes(layout, { text, grid, zero }) {
    const colours = { color: text, gridcolor: grid, zerolinecolor: zero, automargin: true };
    const names = Object.keys(layout).filter((key) => /^[xy]axis\d*$/.test(key));
    return Object.fromEntries(names.map((key) => [key, { ...layout[key], ...colours }]));
  }

  function draw(plot) {
    const { data, layout } = figures[plot.dataset.figure];
    const palette = PALETTES[dark.matches && !printing ? "dark" : "light"];
    const size = printing ? PAPER : { width: plot.clientWidth, height: plot.clientHeight };
    const shown = {
      ...layout,
      ...axes(layout, palette),
      ...size,
      title: undefined,
      autosize: false,
      dragmode: coarse.matches ? false : "zoom", // a finger scrolls the page
      font: { family: "system-ui, sans-serif", size: 11, color: palette.text },
      hoverlabel: { bgcolor: palette.hover, font: { color: palette.text } },
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      showlegend: false,
      margin: { l: 8, r: 12, t: 8, b: 8 },
      uirevision: "kept",
    };
    Plotly.react(plot, data, shown, CONFIG);
    plot.dataset.drawn = printing ? "paper" : "screen";
  }

  function drawNext() {
    const next = plots.find((plot) => plot.dataset.drawn === undefined);
    if (next === undefined) return;
    draw(next);
    setTimeout(drawNext);
  }

  function again() {
    plots.filter((plot) => plot.dataset.drawn !== undefined).forEach(draw);
  }

  let resizing = 0;
  addEventListener("resize", () => {
    clearTimeout(resizing);
    resizing = setTimeout(() => printing || again(), 150);
  });
  dark.addEventListener("change", again);
  addEventListener("beforeprint", () => {
    printing = true;
    plots.forEach(draw);
  });
  addEventListener("afterprint", () => {
    printing = false;
    plots.forEach(draw);
  });
  drawNext();
})();
