/** Trials in the plane of two objectives with their front, or one objective over the trials. */

import { Box, Group, Text, useComputedColorScheme } from "@mantine/core";
import { useMemo, useRef, useState } from "react";
import type { Trial, Tuning } from "../../api/types";
import { Chart } from "../../plots/Chart";
import { ChartButton } from "../../plots/FigureButton";
import { ON_PAPER, PALETTES } from "../../plots/palettes";
import { useStrategies } from "../../server/useCatalogues";
import { count, formatResult } from "../../units/format";
import { frontFigure, historyFigure, volumeFigure, type Look } from "./charts";
import type { ShownNumber } from "./figures";
import { firstTrial } from "./space";
import type { Point, TuningParts } from "./points";
import { Choice } from "../../ui/Entry";
import { Fault, Note } from "../../ui/Messages";
import { Card } from "../../ui/Card";
import ui from "../../ui/ui.module.css";

interface Props extends Pick<TuningParts, "tuning" | "objectives" | "points" | "colour"> {
  readonly trials: readonly Trial[];
  /** Why there are no single trials. */
  readonly fault: Error | null;
  readonly picked: number | null;
  readonly onPick: (trial: number) => void;
}

const HEIGHT = 360;
const LEGEND = ["Over a limit", "Trials", "Front", "Best so far"];

/** Those with a name of their own in the plot: the best of single objectives are the front's ends. */
const namedOf = (points: readonly Point[]) =>
  points.flatMap(({ trial, names }) => {
    const name = names.find((each) => !each.startsWith("Best"));
    return name !== undefined && trial.values !== null
      ? [{ trial, name: trial.feasible ? name : `${name}, over a limit` }]
      : [];
  });

export function SearchCard({ tuning, objectives, points, trials, fault, colour, picked, onPick }: Props) {
  const palette = PALETTES[useComputedColorScheme("light")];
  const several = objectives.length > 1;
  const [[x, y], setAxes] = useState<readonly [number, number]>([0, 1]);
  const draw = useMemo(() => {
    const [shown] = objectives;
    return (look: Look) =>
      !several && shown
        ? historyFigure({ ...look, trials, picked, paper: tuning.paper, first: firstTrial(tuning), shown })
        : frontFigure({ ...look, trials, picked, front: tuning.front, named: namedOf(points), x, y, objectives });
  }, [trials, picked, objectives, several, tuning, points, x, y]);
  const figure = useMemo(() => draw({ palette, colour }), [draw, palette, colour]);
  const strategies = useStrategies();
  const host = useRef<HTMLDivElement>(null);
  const title = several ? "Pareto front" : "The best so far";
  const growth = useRef<HTMLDivElement>(null);
  const light = strategies.find(({ id }) => id === tuning.strategy)?.colour ?? colour;
  const drawOnPaper = () => ({ figure: draw({ palette: ON_PAPER, colour: light }), legend: LEGEND });
  const volume = useMemo(() => volumeFigure(tuning.history, { palette, colour }), [tuning.history, palette, colour]);
  const axis = (which: "x" | "y") => (
    <Choice
      label={which === "x" ? "Across" : "Up"}
      value={String(which === "x" ? x : y)}
      data={objectives.map(({ label }, index) => ({
        value: String(index),
        label,
        disabled: index === (which === "x" ? y : x),
      }))}
      onPick={(value) => setAxes(which === "x" ? [Number(value), y] : [x, Number(value)])}
    />
  );
  return (
    <Card
      aria-label={several ? "Pareto front" : "History"}
      data-trials={trials.length}
      data-front={tuning.front.length}
      title={title}
      tools={
        <>
          {objectives.length > 2 && (
            <Group gap="0.5rem" align="stretch" p="0.5rem 0.9rem 0">
              {axis("x")}
              {axis("y")}
            </Group>
          )}
          {tuning.paper !== null && (
            <Box ml="auto">
              <ChartButton
                title={title}
                file={`ridelab-${tuning.id}-${several ? "front" : "history"}`}
                hostRef={host}
                draw={drawOnPaper}
              />
            </Box>
          )}
        </>
      }
    >
      {tuning.paper === null ? (
        <Text h={HEIGHT} p="1rem" ta="center" c="dimmed" style={{ display: "grid", placeItems: "center" }}>
          The first generation is being computed: {firstTrial(tuning)} and {tuning.population - 1} others.
        </Text>
      ) : (
        <Chart hostRef={host} figure={figure} height={HEIGHT} label={describe(tuning, objectives)} onPoint={onPick} />
      )}
      {fault && <Fault className={ui.note ?? ""}>The single trials could not be read: {fault.message}</Fault>}
      <Note className={ui.note ?? ""}>
        {several
          ? "Large points: the Pareto front. Small ones: the other trials. "
          : "Points: the trials. Line: the best so far. "}
        {tuning.limits.length > 0 && "Crosses: over a limit. "}A click on a point shows its weights.
        {figure.beyond > 0 &&
          ` ${count(figure.beyond, "worse trial")} ${figure.beyond === 1 ? "lies" : "lie"} beyond the axes.`}
      </Note>
      {several && tuning.history.length > 1 && tuning.history.some(({ hypervolume }) => hypervolume !== null) && (
        <Box component="details" className={ui.more ?? ""} p="0 0.9rem 0.6rem">
          <summary>How the front grew</summary>
          <ChartButton
            title="How the front grew"
            file={`ridelab-${tuning.id}-growth`}
            hostRef={growth}
            draw={() => ({
              figure: volumeFigure(tuning.history, { palette: ON_PAPER, colour: light }),
              legend: ["Front"],
            })}
          />
          <Chart
            hostRef={growth}
            figure={volume}
            height={180}
            label="Share of the box under the first trial that the front dominates, over the trials"
          />
          <Note className={ui.note ?? ""}>
            The part of the box between zero and {firstTrial(tuning)} that the front dominates: it flattens when more
            trials find little more.
          </Note>
        </Box>
      )}
    </Card>
  );
}

function describe(tuning: Tuning, objectives: readonly ShownNumber[]): string {
  const { front, paper, history } = tuning;
  const names = objectives.map(({ label }) => label).join(" against ");
  if (objectives.length > 1)
    return `${names}: ${front.length} points on the Pareto front. They can be chosen by “Weights of trial”.`;
  const best = history.at(-1)?.best[0];
  const scale = objectives[0]?.scale ?? 1;
  return `${names} over the trials: ${firstTrial(tuning)} ${formatResult((paper?.values?.[0] ?? NaN) * scale, 4)}, best ${typeof best === "number" ? formatResult(best * scale, 4) : "none yet"}`;
}
