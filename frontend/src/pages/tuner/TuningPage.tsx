/** One tuning: how far it is, what it found, and whether that holds on other roads. */

import { Button, Text, Stack } from "@mantine/core";
import { Link, useParams } from "@tanstack/react-router";
import { useMemo, useState } from "react";
import { api } from "../../api/client";
import { download } from "../../lib/download";
import { address, ask } from "../../api/http";
import { FileMenu } from "../../features/export/FileMenu";
import { Icon } from "../../ui/icons";
import type { Trial, Tuning } from "../../api/types";
import { TUNING, useJob } from "../../jobs/useJob";
import { Page } from "../../ui/Page";
import { useRunInLab } from "../../ui/openInLab";
import type { Catalogues } from "../../server/useCatalogues";
import { ofLimit, ofObjective, useNumericCatalogues } from "./figures";
import { ValidationTable } from "./ValidationTable";
import { pointsOf, type Point, type TuningParts } from "./points";
import { PointsTable, PointTable } from "./PointsTable";
import { firstTrial, tunableOf } from "./space";
import { TuningState } from "./TuningState";
import { humanise } from "../../scenario/schema";
import { withFields } from "../../scenario/fields";
import { Fault, Note } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";
import { useQuery, keepPreviousData, queryOptions } from "@tanstack/react-query";
import { SearchCard } from "./SearchCard";
import { Choice } from "../../ui/Entry";
import { Card } from "../../ui/Card";
import { compact } from "../../ui/IconButton";
import { ShareAddress } from "../../features/share/ShareLink";

/** What weights are looked at beside. */
const BESIDE = ["lqr", "passive"];

export function TuningPage() {
  const { id } = useParams({ from: "/tuner/$id" });
  const catalogues = useNumericCatalogues();
  const { job: tuning, connected, left } = useJob(TUNING, id);
  const strategy = catalogues.strategies.find((each) => each.id === tuning.strategy)?.label ?? tuning.strategy;
  const title = `Weights of ${strategy}`;
  return (
    <Page
      title={title}
      tools={
        <>
          <Button
            aria-label="New tuning"
            classNames={compact}
            leftSection={<Icon name="Plus" size={15} />}
            renderRoot={(props) => <Link to="/tuner" {...props} />}
          >
            New tuning
          </Button>
          <ShareAddress what="tuning" ready />
          <FileMenu contents="Every trial of the complete generations" files={[trialsOf(tuning)]} />
        </>
      }
      heading={`${title}, tuned`}
    >
      <TuningState {...{ tuning, connected, left }} {...catalogues} />
      <TuningResults tuning={tuning} {...catalogues} />
    </Page>
  );
}

const trialsOf = ({ id }: Tuning) => ({
  label: "JSON",
  icon: <Icon name="Braces" size={16} />,
  save: () => download(address("/tunings/{id}/trials", { path: { id } }), `ridelab-tuning-${id}.json`),
});

function TuningResults({ tuning, form, strategies, figures }: { readonly tuning: Tuning } & Catalogues) {
  const objectives = useMemo(
    () => tuning.objectives.map((each) => ofObjective(each, figures)),
    [tuning.objectives, figures],
  );
  const limits = useMemo(() => tuning.limits.map((each) => ofLimit(each, figures)), [tuning.limits, figures]);
  const tunable = useMemo(() => tunableOf(form, tuning.strategy), [form, tuning.strategy]);
  const points = useMemo(
    () =>
      pointsOf(
        tuning,
        objectives.map(({ label }) => label),
      ),
    [tuning, objectives],
  );
  const load = useRunInLab(({ weights }: Trial) =>
    api.createRun(withFields(tuning.scenario, weights), [...new Set([tuning.strategy, ...BESIDE])]),
  );
  const colour = strategies.find(({ id }) => id === tuning.strategy)?.colour ?? "currentColor";
  const warning = warningOf(tuning);
  return (
    <>
      {warning !== null && (
        <Text role="status" className={ui.warning ?? ""}>
          {warning}
        </Text>
      )}
      {load.error !== null && <Fault size="md">These weights could not be loaded: {load.error}</Fault>}
      <TuningPlot {...{ tuning, objectives, limits, tunable, points, colour, load }} />
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

function TuningPlot({ tuning, objectives, limits, tunable, points, colour, load }: TuningParts) {
  const [selectedNumber, setSelectedNumber] = useState<number | null>(null);
  const trials = useQuery({ ...trialsQuery(tuning), enabled: tuning.paper !== null });
  const all = trials.data?.trials ?? NO_TRIALS;
  const opening = points.find(({ names }) => names.includes("Balanced")) ?? points.at(-1);
  const picked =
    all.find(({ number }) => number === selectedNumber) ??
    points.find(({ trial }) => trial.number === selectedNumber)?.trial ??
    opening?.trial ??
    null;
  return (
    <div className={ui.beside}>
      <SearchCard
        {...{ tuning, objectives, points, colour }}
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
  const named = points.map(({ trial, names }) => ({
    value: String(trial.number),
    label: `${trial.number}: ${names.join(", ")}`,
  }));
  const others = [...front, picked].filter(
    ({ number }, index, all) =>
      !points.some(({ trial }) => trial.number === number) && all.findIndex((each) => each.number === number) === index,
  );
  return [...named, ...others.map(({ number }) => ({ value: String(number), label: `${number}` }))];
}

/** Every trial so far: asked for anew with every generation. */
const trialsQuery = (tuning: Tuning) =>
  queryOptions({
    queryKey: ["tuning trials", tuning.id, tuning.trials.done + tuning.trials.failed],
    queryFn: ({ signal }) => ask("get", "/tunings/{id}/trials", { path: { id: tuning.id } }, signal),
    staleTime: Infinity,
    gcTime: 60_000,
    placeholderData: keepPreviousData,
  });
