/** One tuning: how far it is, what it found, and whether that holds on other roads. */

import { Button, Text } from "@mantine/core";
import { Link, useParams } from "@tanstack/react-router";
import { useMemo } from "react";
import { api } from "../../api/client";
import { download } from "../../lib/download";
import { address } from "../../api/http";
import { FileMenu } from "../../features/export/FileMenu";
import { ShareAddress } from "../../features/share/ShareAddress";
import { compact } from "../../ui/compact";
import { IconBraces, IconPlus } from "../../ui/icons";
import type { Trial, Tuning } from "../../api/types";
import { TUNING, useJob } from "../../jobs/useJob";
import { Page } from "../../ui/Page";
import { useRunInLab } from "../../ui/useOpenInLab";
import type { Catalogues } from "../../server/useCatalogues";
import { ofLimit, ofObjective, useNumericCatalogues } from "./figures";
import { ValidationTable } from "./ValidationTable";
import { pointsOf } from "./points";
import { PointsTable } from "./PointsTable";
import { firstTrial, tunableOf } from "./space";
import { TuningPlot } from "./TuningPlot";
import { TuningState } from "./TuningState";
import { humanise } from "../../scenario/schema";
import { withFields } from "../../scenario/fields";
import { Fault } from "../../ui/Fault";
import ui from "../../ui/ui.module.css";

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
            leftSection={<IconPlus size={15} />}
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
  icon: <IconBraces size={16} />,
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
