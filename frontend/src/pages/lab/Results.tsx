/** The results: the car and the ride on the bump first, then the numbers, then every other signal. */

import { memo, useMemo, useState } from "react";
import { Skeleton, Text } from "@mantine/core";
import { useIntersection } from "@mantine/hooks";
import type { FigureTemplate, Strategy } from "../../api/types";
import { PlotGrid, RoadStrip, useShownCurves } from "../../plots/PlotGrid";
import { useLabContext, useLab } from "../../lab/context";
import { simulatedPart, type ResultView } from "../../lab/resultView";
import { LazyPart } from "../../ui/LazyPart";
import classes from "../../ui/shell.module.css";
import plots from "../../plots/plots.module.css";
import {
  CarView,
  ChangeChips,
  FrequencyPart,
  FuzzyPart,
  InstantPart,
  RequirementsCard,
  StageLegend,
  Tables,
  VerdictLine,
} from "./afterCurves";
import { useLabFigures } from "../../lab/recordings";
import { useCatalogue } from "../../server/useCatalogues";
import { getAt } from "../../scenario/path";
import { useCurves } from "../../plots/useDetail";
import { Caution, Note } from "../../ui/Messages";
import { Blank } from "../../ui/Page";

interface Props {
  readonly strategies: readonly Strategy[];
  readonly resultView: ResultView | null;
}

export const Results = memo(function Results({ strategies, resultView }: Props) {
  const failure = useLab((state) => state.failure);
  const none = useLab((state) => state.strategies.length === 0);
  const shown = useLab((state) => state.shown !== null);
  const refused = useLab((state) =>
    [...Object.values(state.serverErrors.fields), ...state.serverErrors.general].join(". "),
  );
  const { lab } = useLabContext();
  const stale = useLab((state) => state.stale);
  if (failure?.kind === "notFound") return <NotFound />;
  if (none) return <NothingChosen suggestion={strategies.map(({ id }) => id)} />;
  const toPaper = { label: "Open the paper’s scenario", onClick: lab.openPaper };
  if (failure?.kind === "failed" && !shown)
    return (
      <Blank title="This page could not be shown" text={failure.message} action={{ ...toPaper, label: "Try again" }} />
    );
  if (refused && !shown) return <Blank title="This scenario could not be shown" text={refused} action={toPaper} />;
  if (!resultView || resultView.ids.length === 0) return <Loading />;
  return (
    <div
      className={classes.results}
      data-stale={stale || undefined}
      data-testid="results"
      data-source={resultView.shown.source}
      data-run={resultView.shown.runId ?? undefined}
    >
      <Conclusion resultView={resultView} />
      {resultView.shown.missing === null ? (
        <Histories {...{ strategies, resultView }} />
      ) : (
        <>
          <LazyPart>
            <Tables resultView={resultView} />
            <RequirementsCard resultView={resultView} />
          </LazyPart>
          <NoHistories reason={resultView.shown.missing} />
        </>
      )}
    </div>
  );
});

/** How high they will be [px], by the window's width: texts and tools wrap, and from `sm` on the form stands beside them. */
const CONCLUSION = { base: 129, xs: 94, sm: 111, md: 76 };
const CAR = { base: 168, sm: 206, lg: 168 };

interface PartProps {
  readonly resultView: ResultView;
}

const Conclusion = memo(function Conclusion({ resultView }: PartProps) {
  return (
    <>
      <LazyPart fallback={<Skeleton h={CONCLUSION} radius={8} />}>
        <VerdictLine resultView={resultView} />
        <ChangeChips resultView={simulatedPart(resultView)} />
      </LazyPart>
      <ResultCautions resultView={resultView} />
      <RoadsNote resultView={resultView} />
      <RecordingNotes resultView={resultView} />
      <LazyPart>
        <InstantPart resultView={resultView} />
        <FuzzyPart resultView={resultView} />
      </LazyPart>
    </>
  );
});

const CarOnRoad = memo(function CarOnRoad({
  resultView,
  road,
}: PartProps & { readonly road: FigureTemplate | undefined }) {
  return (
    <>
      <LazyPart fallback={<Skeleton h={CAR} radius={8} />}>
        <CarView resultView={simulatedPart(resultView)} />
      </LazyPart>
      {road && <RoadStrip template={road} resultView={resultView} />}
    </>
  );
});

const Numbers = memo(function Numbers({ resultView }: PartProps) {
  return (
    <LazyPart fallback={<Skeleton h={400} radius={8} />}>
      <StageLegend resultView={resultView} />
      <Tables resultView={resultView} />
      <RequirementsCard resultView={resultView} />
    </LazyPart>
  );
});

const Responses = memo(function Responses({ resultView }: PartProps) {
  return (
    <LazyPart>
      <FrequencyPart resultView={resultView} />
    </LazyPart>
  );
});

/** What an element shows of a result: under a moving slider as it was, until it is in sight. */
function useInSight(newest: ResultView) {
  const { ref, entry } = useIntersection<HTMLDivElement>();
  const [shown, setShown] = useState(newest);
  const follows = newest.shown.source === "exact" || (entry?.isIntersecting ?? true);
  if (follows && shown !== newest) setShown(newest);
  return [ref, shown] as const;
}

const Histories = memo(function Histories({ strategies, resultView }: PartProps & Pick<Props, "strategies">) {
  const [catalogue, figures] = [useCatalogue(), useLabFigures(strategies)];
  const [ride, rest] = useMemo(() => {
    const drawn = Object.entries(figures).flatMap(([name, template]) => (name === "road" ? [] : [template]));
    const isRide = ({ layout }: FigureTemplate) => catalogue.paper_signals.includes(layout.meta.signal);
    return [drawn.filter(isRide), drawn.filter((template) => !isRide(template))];
  }, [catalogue, figures]);
  const curves = useShownCurves(resultView);
  const [numbersRef, numbers] = useInSight(resultView);
  const [responsesRef, responses] = useInSight(resultView);
  return (
    <>
      <CarOnRoad resultView={resultView} road={figures.road} />
      <PlotGrid templates={ride} curves={curves} />
      <div ref={numbersRef} className={classes.results}>
        <Numbers resultView={numbers} />
      </div>
      <PlotGrid templates={rest} curves={curves} />
      <div ref={responsesRef}>
        <Responses resultView={responses} />
      </div>
    </>
  );
});

function NothingChosen({ suggestion }: { readonly suggestion: readonly string[] }) {
  const { lab } = useLabContext();
  return (
    <Blank
      title="No strategy chosen"
      text="Switch on at least one above to see how the car rides."
      action={{ label: "Show all strategies", onClick: () => lab.setStrategies(suggestion) }}
    />
  );
}

function NotFound() {
  const { lab, labAddress } = useLabContext();
  const [title, text] =
    labAddress.get().slug === null
      ? ["There is no run at this address", "The link may be incomplete, or the run was made on another server."]
      : [
          "There is no shared result at this address",
          "The link may be incomplete, or it was made on another server. Ask the sender for the complete address.",
        ];
  return <Blank {...{ title, text }} action={{ label: "Open the paper’s scenario", onClick: lab.openPaper }} />;
}

/** In place of the car and the plots. */
function NoHistories({ reason }: { readonly reason: string }) {
  return <Blank title="This result has no time histories" text={`${reason} The tables are as they were computed.`} />;
}

/** The results' places before there are any: the same heights, so that nothing jumps. */
function Loading() {
  return (
    <div className={classes.results} aria-busy aria-label="Loading results">
      <Skeleton h={150} radius={8} />
      <Skeleton h={66} radius={8} />
      <div className={plots.grid}>
        {Array.from({ length: 6 }, (_, index) => (
          <Skeleton key={index} height={210} radius={8} />
        ))}
      </div>
    </div>
  );
}

/** How each recorded drive was placed on this road, and what it lacks. */
function RecordingNotes({ resultView }: { readonly resultView: ResultView }) {
  return resultView.strategies.map(({ id, label }) => {
    const notes = resultView.summaries[id]?.recording?.notes ?? [];
    return (
      notes.length > 0 && (
        <Text key={id} size="xs" c="dimmed" m="0 0 0.5rem 0.2rem" data-testid="recording">
          {label}: {notes.join(". ")}.
        </Text>
      )
    );
  });
}

/** The paper's own values are cautioned in the form alone: beside them every result would be. */
function ResultCautions({ resultView }: PartProps) {
  return resultView.shown.cautions
    .filter(({ kind }) => kind !== "paper_sag")
    .map(({ text }) => <Caution key={text} text={text} />);
}

/** Says over how many roads the numbers and the curves are, and which road the rest is of. */
function RoadsNote({ resultView }: { readonly resultView: ResultView }) {
  const { shown, differences } = resultView;
  const { over, scenario, source } = shown;
  const roads = useLab((state) => state.roads);
  const hasMeans = useCurves(resultView).roads !== undefined;
  const seed = getAt(scenario, "/road/seed");
  const first = `road seed ${typeof seed === "number" ? seed : "?"}`;
  if (over === null && (source === "exact" || roads === 1)) return null;
  return (
    <Note m="0 0 0.5rem 0.2rem" data-testid="roads">
      {over === null ? (
        `While a value is dragged: ${first} only; then the mean of ${roads} roads.`
      ) : (
        <>
          Mean of {over.roads} roads ± 95 % interval.{" "}
          {hasMeans
            ? `Curves: ${differences ? "differences of the means" : "mean and range"}. Car, road and events: ${first}.`
            : `Curves, car and events are of the first road only, ${first}; the table is of all roads.`}
        </>
      )}
    </Note>
  );
}
