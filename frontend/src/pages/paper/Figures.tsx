/** The paper's figures, made by us: each is drawn when it comes near the window. */

import { Box, Group, SegmentedControl, Text } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { memo, useCallback, useMemo, useState } from "react";
import type { PaperFigure, JsonObject, JsonValue, MadeFigure } from "../../api/types";
import { Chart, type ChartFigure } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { StrategyKey } from "../../ui/StrategyKey";
import { useChoices } from "./choices";
import { typeset } from "./numbers";
import { attributionQuery, paperFiguresQuery, Answered, useVisible } from "./Waiting";
import { choicesOf } from "../../ui/Entry";
import ui from "../../ui/ui.module.css";
import { Columns } from "../../ui/Card";

const HEIGHT = 250;
/** Two of them side by side on A4 [px]. */
const PRINTED_WIDTH = 490;

export function Figures() {
  const [choices] = useChoices();
  // One after the other: the server works on one of them at a time.
  const { isPending: busy } = useQuery({
    ...attributionQuery(choices),
    enabled: false,
    notifyOnChangeProps: ["isPending"],
  });
  return (
    <Answered
      query={useQuery({ ...paperFiguresQuery(choices), enabled: !busy })}
      waiting="Drawing the paper’s figures from our own runs"
      height={17 * 190}
    >
      {(figures) => <Panels figures={figures} />}
    </Answered>
  );
}

function Panels({ figures }: { readonly figures: readonly PaperFigure[] }) {
  const [range, setRange] = useState<"whole" | "bump">("whole");
  return (
    <>
      <Text className={ui.lead ?? ""} mb="0.6rem">
        Numbered as in the paper, with Ridelab’s readings; the paper’s Figures 1, 2, 7, 9 and 18 are sketches. Drag over
        a figure to look closer, double click for all of it.
      </Text>
      <SegmentedControl
        aria-label="Figures 8 to 22 over"
        data-unprinted
        mb="0.6rem"
        value={range}
        data={choicesOf({ whole: "Whole road", bump: "Bump only" })}
        onChange={setRange}
      />
      <Columns className={ui.pairs ?? ""}>
        {figures.map((figure) => (
          <Panel key={figure.number} figure={figure} bumpOnly={range === "bump"} />
        ))}
      </Columns>
    </>
  );
}

interface PanelProps {
  readonly figure: PaperFigure;
  readonly bumpOnly: boolean;
}

const Panel = memo(function Panel({ figure: { number, title, caption, figure }, bumpOnly }: PanelProps) {
  const { ref, visible, printed } = useVisible();
  const legend = useMemo(() => legendOf(figure), [figure]);
  const { chart, button } = useChart({
    title: `Figure ${number}: ${title}`,
    file: `ridelab-paper-figure-${number}`,
    draw: useCallback(
      (look: Look) => {
        const shown = drawn(figure, { ...look, bumpOnly });
        return {
          figure: look.onPaper ? withNamedShapes(shown) : shown,
          legend: legend.map(({ name }) => name),
        };
      },
      [figure, bumpOnly, legend],
    ),
  });
  return (
    <figure
      ref={ref}
      className={ui.card}
      style={{ margin: 0, paddingBottom: "0.6rem", scrollMarginTop: "4rem" }}
      id={`figure-${number}`}
      data-drawn={visible || undefined}
    >
      <Box component="figcaption" p="0.6rem 0.9rem 0.3rem">
        <Box component="h3" m={0} fz="sm" fw={600} lh="1.35">
          <Box component="span" mr="0.3rem" fw={700} c="var(--accent)">
            Figure {number}
          </Box>{" "}
          {title}
          {button}
        </Box>
        <Group component="ul" className={ui.list ?? ""} gap="0.1rem 0.9rem" mt="0.3rem" fz="xs" c="dimmed">
          {legend.map(({ name, colour, dash, fill }) => (
            <li key={name} className={ui.named}>
              {fill === null ? (
                <StrategyKey strategy={{ colour, dash }} />
              ) : (
                <span className={ui.area} style={{ background: fill }} aria-hidden />
              )}
              {name}
            </li>
          ))}
        </Group>
      </Box>
      <div style={{ height: HEIGHT }}>
        <Chart
          {...chart}
          figure={visible ? chart.figure : null}
          height={HEIGHT}
          width={printed ? PRINTED_WIDTH : undefined}
          label={`Figure ${number}: ${title}; ${legend.map(({ name }) => name).join(", ")}`}
        />
      </div>
      <Box component="p" m={0} p="0.3rem 0.9rem 0" fz="xs" lh="1.4" c="dimmed">
        {typeset(caption)}
      </Box>
    </figure>
  );
});

/** As --surface in global.css: plotly takes no variables. */
const SURFACES: Readonly<Record<Look["scheme"], string>> = { light: "#ffffff", dark: "#1a1b1e" };
/** The name of the stage's shape. */
const BUMP = "Bump";
const MARGIN = { l: 62, r: 14, t: 6, b: 44 } as const;

function isObject(value: JsonValue | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

const text = (value: JsonValue | undefined, otherwise: string) => (typeof value === "string" ? value : otherwise);

interface DrawnLook extends Pick<Look, "palette" | "scheme"> {
  /** Of a time history only what happens on the bump. */
  readonly bumpOnly: boolean;
}

export function drawn(figure: MadeFigure, { palette, scheme, bumpOnly }: DrawnLook): ChartFigure {
  const { data, layout } = figure;
  const axis = { color: palette.text, gridcolor: palette.grid, zerolinecolor: palette.zero, automargin: true };
  const bump = bumpOnly ? bumpRange(figure) : null;
  return {
    data: [...data],
    layout: {
      font: { family: "inherit", color: palette.text, size: 12 },
      margin: MARGIN,
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      showlegend: false,
      hovermode: "x unified",
      hoverlabel: {
        bgcolor: SURFACES[scheme],
        bordercolor: palette.zero,
        font: { color: palette.text, size: 12 },
        namelength: -1,
      },
      dragmode: "zoom",
      xaxis: { ...layout.xaxis, ...axis, ...titled(layout.xaxis), ...(bump && { range: bump }) },
      yaxis: { ...layout.yaxis, ...axis, ...titled(layout.yaxis) },
      shapes: shapesOf(figure),
    },
  };
}

const titled = (axis: JsonObject | undefined) =>
  isObject(axis?.title) ? { title: { ...axis.title, standoff: 6, font: { size: 12 } } } : {};

function shapesOf({ layout: { shapes } }: MadeFigure): readonly JsonObject[] {
  return Array.isArray(shapes) ? (shapes as readonly JsonObject[]) : [];
}

/** Shown before the bump and after it [m]: the previewed road, and how the car settles. */
const [BEFORE, AFTER] = [8, 15];

/** From a little before the bump's stage to a little after; `null` where the figure has none. */
export function bumpRange(figure: MadeFigure): readonly [number, number] | null {
  const bump = shapesOf(figure).find(
    ({ name, x0, x1 }) => name === BUMP && typeof x0 === "number" && typeof x1 === "number",
  );
  return bump ? [Number(bump.x0) - BEFORE, Number(bump.x1) + AFTER] : null;
}

interface LegendEntry {
  readonly name: string;
  readonly colour: string;
  readonly dash: string;
  /** Where it is an area, not a line. */
  readonly fill: string | null;
}

/** Curves first, then what stands behind them: stages, bands, reference lines. */
export const legendOf = (figure: MadeFigure): readonly LegendEntry[] => [
  ...figure.data.map((trace) => entryOf(trace.name, trace, typeof trace.fill === "string" && trace.fill !== "none")),
  ...shapesOf(figure).flatMap((shape) =>
    typeof shape.name === "string" ? [entryOf(shape.name, shape, shape.type === "rect")] : [],
  ),
];

function entryOf(name: string, { line, fillcolor }: JsonObject, isArea: boolean): LegendEntry {
  const { color, dash } = isObject(line) ? line : {};
  return {
    name,
    colour: text(color, "currentColor"),
    dash: text(dash, "solid"),
    fill: isArea ? text(fillcolor, "currentColor") : null,
  };
}

/** With stages, bands and reference lines in its own legend: on paper there is no other one. */
const withNamedShapes = ({ data, layout }: ChartFigure): ChartFigure => ({
  data,
  layout: {
    ...layout,
    shapes: layout.shapes.map((shape) => ({ ...shape, showlegend: typeof shape.name === "string" })),
  },
});
