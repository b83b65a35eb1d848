/** One tuning: how far it is, what it found, and whether that holds on other roads. */

import { Button, Text, Stack, Box, Group } from "@mantine/core";
import { useParams } from "@tanstack/react-router";
import { useCallback, useMemo, useState } from "react";
import { api } from "../../api/client";
import { download } from "../../lib/download";
import { address, ask } from "../../api/http";
import { FileMenu } from "../../features/export/FileMenu";
import { ShareAddress } from "../../features/share/ShareLink";
import { Icon } from "../../ui/icons";
import type { Trial, Tuning } from "../../api/types";
import { TUNING, useJob } from "../../jobs/useJob";
import { NewJob } from "../../jobs/Jobs";
import { useStrategies } from "../../server/useCatalogues";
import { Page } from "../../ui/Page";
import { useRunInLab } from "../../ui/openInLab";
import {
  useNumericCatalogues,
  pointsOf,
  type Point,
  type TuningParts,
  type ShownNumber,
  firstTrial,
  tunableOf,
  shownOf,
} from "./space";
import { Conclusion, ValidationTable } from "./ValidationTable";
import { PointsTable, PointTable } from "./PointsTable";
import { TuningState } from "./TuningState";
import { humanise } from "../../scenario/schema";
import { withFields } from "../../scenario/fields";
import { Fault, Note } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";
import { useQuery, keepPreviousData } from "@tanstack/react-query";
import { Choice } from "../../ui/Entry";
import { Card } from "../../ui/Card";
import { Chart } from "../../plots/Chart";
import { useChart, type Look } from "../../plots/useChart";
import { count, formatResult } from "../../units/format";
import { coloursOf, frontFigure, historyFigure, volumeFigure } from "./charts";

/** What weights are looked at beside. */
const BESIDE = ["lqr", "passive"];

export function TuningPage() {
  const { id } = useParams({ from: "/tuner/$id" });
  const strategies = useStrategies();
  const { job: tuning, connected, left } = useJob(TUNING, id);
  const title = `Weights of ${strategies.find((each) => each.id === tuning.strategy)?.label ?? tuning.strategy}`;
  const trials = {
    label: "JSON",
    icon: <Icon name="Braces" size={16} />,
    save: () => download(address("/tunings/{id}/trials", { path: { id } }), `ridelab-tuning-${id}.json`),
  };
  return (
    <Page
      title={title}
      tools={
        <>
          <NewJob to="/tuner" label="New tuning" />
          <ShareAddress what="tuning" ready />
          <FileMenu contents="Every trial of the complete generations" files={[trials]} />
        </>
      }
      heading={`${title}, tuned`}
    >
      <TuningState {...{ tuning, connected, left }} />
      <TuningResults tuning={tuning} />
    </Page>
  );
}

function TuningResults({ tuning }: { readonly tuning: Tuning }) {
  const { form, figures } = useNumericCatalogues();
  const objectives = useMemo(
    () => tuning.objectives.map((each) => shownOf(each, figures)),
    [tuning.objectives, figures],
  );
  const limits = useMemo(() => tuning.limits.map((each) => shownOf(each, figures)), [tuning.limits, figures]);
  const tunable = useMemo(() => tunableOf(form, tuning.strategy), [form, tuning.strategy]);
  const points = useMemo(() => pointsOf(tuning, objectives), [tuning, objectives]);
  const load = useRunInLab(({ weights }: Trial) =>
    api.createRun(withFields(tuning.scenario, weights), [...new Set([tuning.strategy, ...BESIDE])]),
  );
  const warning = warningOf(tuning);
  return (
    <>
      {warning !== null && (
        <Text role="status" className={ui.warning ?? ""}>
          {warning}
        </Text>
      )}
      {load.error !== null && <Fault size="md">These weights could not be loaded: {load.error}</Fault>}
      <Conclusion {...{ tuning, objectives, figures }} />
      <TuningPlot {...{ tuning, objectives, limits, tunable, points, load }} />
      {points.length > 0 && <PointsTable {...{ tuning, objectives, limits, tunable, points, load }} />}
      <ValidationTable {...{ tuning, objectives, figures }} />
    </>
  );
}

function warningOf(tuning: Tuning): string | null {
  const { paper, trials } = tuning;
  if (paper === null) return null;
  if (trials.feasible === 0) return "No trial so far is within the limits on every training road.";
  if (paper.status === "failed")
    return `${humanise(firstTrial(tuning))} could not be driven: there is nothing to compare with.`;
  return paper.feasible
    ? null
    : `${humanise(firstTrial(tuning))} are over a limit on the training roads: weights within the limits may give larger objectives.`;
}

const NO_TRIALS: readonly Trial[] = [];

function TuningPlot({ tuning, objectives, limits, tunable, points, load }: TuningParts) {
  const [selectedNumber, setSelectedNumber] = useState<number | null>(null);
  // Asked for anew with every generation.
  const trials = useQuery({
    queryKey: ["tuning trials", tuning.id, tuning.trials.done + tuning.trials.failed],
    queryFn: ({ signal }) => ask("get", "/tunings/{id}/trials", { path: { id: tuning.id } }, signal),
    staleTime: Infinity,
    gcTime: 60_000,
    placeholderData: keepPreviousData,
    enabled: tuning.paper !== null,
  });
  const all = trials.data?.trials ?? NO_TRIALS;
  const opening = points.find(({ names }) => names.includes("Balanced")) ?? points.at(-1);
  const picked =
    [...all, ...points.map(({ trial }) => trial)].find(({ number }) => number === selectedNumber) ?? opening?.trial;
  return (
    <div className={ui.beside}>
      <SearchCard
        {...{ tuning, objectives, points }}
        trials={all}
        fault={trials.error}
        picked={picked?.number ?? null}
        onPick={setSelectedNumber}
      />
      {picked && (
        <Card aria-label="Selected point" data-trial={picked.number}>
          <Stack gap="sm" p="0.8rem 0.9rem">
            <Choice
              label="Weights of trial"
              value={String(picked.number)}
              data={options(points, tuning.front, picked)}
              onPick={(value) => setSelectedNumber(Number(value))}
            />
            <PointTable {...{ tuning, objectives, limits, tunable }} trial={picked} />
            {picked.status === "failed" && <Fault>Failed: {picked.reason}</Fault>}
            {picked.number !== tuning.paper?.number && <Note>Struck through: {firstTrial(tuning)}.</Note>}
            <Button variant="filled" loading={load.opening?.number === picked.number} onClick={() => load.open(picked)}>
              Load in lab
            </Button>
          </Stack>
        </Card>
      )}
    </div>
  );
}

function options(points: readonly Point[], front: readonly Trial[], picked: Trial) {
  const names = new Map(points.map((point) => [point.trial.number, point.names.join(", ")]));
  const numbers = new Set([...names.keys(), ...[...front, picked].map(({ number }) => number)]);
  return [...numbers].map((number) => {
    const name = names.get(number);
    return { value: String(number), label: name === undefined ? String(number) : `${number}: ${name}` };
  });
}

interface SearchProps extends Pick<TuningParts, "tuning" | "objectives" | "points"> {
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

function SearchCard({ tuning, objectives, points, trials, fault, picked, onPick }: SearchProps) {
  const several = objectives.length > 1;
  const [[x, y], setAxes] = useState<readonly [number, number]>([0, 1]);
  const title = several ? "Pareto front" : "The best so far";
  const search = useChart({
    title,
    file: `ridelab-${tuning.id}-${several ? "front" : "history"}`,
    draw: useMemo(() => {
      const { front, paper } = tuning;
      const [shown] = objectives;
      return (look: Look) => {
        const input = { ...coloursOf(look, tuning.strategy), trials, picked };
        const figure =
          !several && shown
            ? historyFigure({ ...input, paper, first: firstTrial(tuning), shown })
            : frontFigure({ ...input, front, named: namedOf(points), x, y, objectives });
        return { figure, legend: LEGEND };
      };
    }, [trials, picked, objectives, several, tuning, points, x, y]),
  });
  const beyond = search.drawn?.figure.beyond ?? 0;
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
          {tuning.paper !== null && <Box ml="auto">{search.button}</Box>}
        </>
      }
    >
      {tuning.paper === null ? (
        <Text h={HEIGHT} p="1rem" ta="center" c="dimmed" style={{ display: "grid", placeItems: "center" }}>
          The first generation is being computed: {firstTrial(tuning)} and {tuning.population - 1} others.
        </Text>
      ) : (
        <Chart {...search.chart} height={HEIGHT} label={describe(tuning, objectives)} onPoint={onPick} />
      )}
      {fault && <Fault className={ui.note ?? ""}>The single trials could not be read: {fault.message}</Fault>}
      <Note className={ui.note ?? ""}>
        {several
          ? "Large points: the Pareto front. Small ones: the other trials. "
          : "Points: the trials. Line: the best so far. "}
        {tuning.limits.length > 0 && "Crosses: over a limit. "}A click on a point shows its weights.
        {beyond > 0 && ` ${count(beyond, "worse trial")} ${beyond === 1 ? "lies" : "lie"} beyond the axes.`}
      </Note>
      {several && tuning.history.length > 1 && tuning.history.some(({ hypervolume }) => hypervolume !== null) && (
        <Growth tuning={tuning} />
      )}
    </Card>
  );
}

function Growth({ tuning }: Pick<SearchProps, "tuning">) {
  const { id, strategy, history } = tuning;
  const { chart, button } = useChart({
    title: "How the front grew",
    file: `ridelab-${id}-growth`,
    draw: useCallback(
      (look: Look) => ({ figure: volumeFigure(history, coloursOf(look, strategy)) }),
      [history, strategy],
    ),
  });
  return (
    <Box component="details" className={ui.more ?? ""} p="0 0.9rem 0.6rem">
      <summary>How the front grew</summary>
      {button}
      <Chart
        {...chart}
        height={180}
        label="Share of the box under the first trial that the front dominates, over the trials"
      />
      <Note className={ui.note ?? ""}>
        The part of the box between zero and {firstTrial(tuning)} that the front dominates: it flattens when more trials
        find little more.
      </Note>
    </Box>
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
