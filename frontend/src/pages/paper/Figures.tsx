/** The paper's figures, made by us: each is drawn when it comes near the window. */

import { Box, Group, SegmentedControl, Text, useComputedColorScheme } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { memo, useMemo, useRef, useState } from "react";
import type { PaperFigure } from "../../api/types";
import { Chart } from "../../plots/Chart";
import { ChartButton } from "../../plots/FigureButton";
import { ON_PAPER, PALETTES } from "../../plots/palettes";
import { StrategyKey } from "../../ui/StrategyKey";
import type { Choices } from "./choices";
import classes from "./figures.module.css";
import { drawn, legendOf, withNamedShapes, type Scheme } from "./render";
import { typeset } from "./numbers";
import { attributionQuery, paperFiguresQuery } from "./queries";
import { useVisible, Fault, Waiting } from "./Waiting";
import ui from "../../ui/ui.module.css";

const HEIGHT = 250;
/** Two of them side by side on A4 [px]. */
const PRINTED_WIDTH = 490;

export function Figures({ choices }: { readonly choices: Choices }) {
  // One after the other: the server works on one of them at a time.
  const { isPending: busy } = useQuery({
    ...attributionQuery(choices),
    enabled: false,
    notifyOnChangeProps: ["isPending"],
  });
  const { data, error, refetch } = useQuery({ ...paperFiguresQuery(choices), enabled: !busy });
  const scheme = useComputedColorScheme("light");
  const [range, setRange] = useState<"whole" | "bump">("whole");
  if (error && !data) return <Fault message={error.message} onRetry={() => void refetch()} />;
  if (!data) return <Waiting what="Drawing the paper’s figures from our own runs" height={17 * 190} />;
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
        data={[
          { value: "whole", label: "Whole road" },
          { value: "bump", label: "Bump only" },
        ]}
        onChange={setRange}
      />
      <div className={classes.grid}>
        {data.map((figure) => (
          <Panel key={figure.number} figure={figure} scheme={scheme} bumpOnly={range === "bump"} />
        ))}
      </div>
    </>
  );
}

interface PanelProps {
  readonly figure: PaperFigure;
  readonly scheme: Scheme;
  readonly bumpOnly: boolean;
}

const Panel = memo(function Panel({ figure: { number, title, caption, figure }, scheme, bumpOnly }: PanelProps) {
  const { ref, visible, printed } = useVisible();
  const shown = useMemo(
    () => (visible ? drawn(figure, { palette: PALETTES[scheme], scheme, bumpOnly }) : null),
    [visible, figure, scheme, bumpOnly],
  );
  const legend = useMemo(() => legendOf(figure), [figure]);
  const host = useRef<HTMLDivElement>(null);
  return (
    <figure
      ref={ref}
      className={`${ui.card} ${classes.panel}`}
      id={`figure-${number}`}
      data-drawn={visible || undefined}
    >
      <Box component="figcaption" p="0.6rem 0.9rem 0.3rem">
        <Box component="h3" m={0} fz="sm" fw={600} lh="1.35">
          <Box component="span" mr="0.3rem" fw={700} c="var(--accent)">
            Figure {number}
          </Box>{" "}
          {title}
          <ChartButton
            title={`Figure ${number}: ${title}`}
            file={`ridelab-paper-figure-${number}`}
            hostRef={host}
            draw={() => ({
              figure: withNamedShapes(drawn(figure, { palette: ON_PAPER, scheme: "light", bumpOnly })),
              legend: legend.map(({ name }) => name),
            })}
          />
        </Box>
        <Group component="ul" className={ui.list ?? ""} gap="0.1rem 0.9rem" mt="0.3rem" fz="xs" c="dimmed">
          {legend.map(({ name, colour, dash, fill }) => (
            <li key={name} className={ui.named}>
              {fill === null ? (
                <StrategyKey strategy={{ colour, dash }} />
              ) : (
                <span className={classes.fill} style={{ background: fill }} aria-hidden />
              )}
              {name}
            </li>
          ))}
        </Group>
      </Box>
      <div style={{ height: HEIGHT }}>
        <Chart
          hostRef={host}
          figure={shown}
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
