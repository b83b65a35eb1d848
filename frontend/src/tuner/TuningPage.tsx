/** One tuning: how far it is, what it found, and whether that holds on other roads. */

import { Anchor, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { Link } from "@tanstack/react-router";
import { useMemo } from "react";
import { explain, isNotFound, isTransient } from "../api/problem";
import type { Strategy, Tuning } from "../api/types";
import type { Figure } from "../batch/figures";
import type { Group } from "../editor/schema";
import { TUNING, useJob } from "../jobs/useJob";
import { Blank, CouldNotLoad } from "../shell/Blank";
import { ofLimit, ofObjective } from "./figures";
import { ValidationTable } from "./ValidationTable";
import { pointsOf } from "./points";
import { PointsTable } from "./PointsTable";
import { tunableOf } from "./space";
import { TuningPlot } from "./TuningPlot";
import { TuningState } from "./TuningState";
import { useLoad } from "./useLoad";
import { Fault } from "../ui/Fault";
import ui from "../ui/ui.module.css";
import { Loading } from "../ui/Loading";

interface Props {
  readonly id: string;
  /** All there is to know first; `null` until it is there. */
  readonly catalogues: { readonly form: Group; readonly strategies: readonly Strategy[]; readonly figures: readonly Figure[] } | null;
}

export function TuningPage({ id, catalogues }: Props) {
  const { job: tuning, error, connected, left } = useJob(TUNING, id);
  const strategy = catalogues?.strategies.find((each) => each.id === tuning?.strategy)?.label;
  useDocumentTitle(`${strategy === undefined ? "Tuning" : `Weights of ${strategy}`} · Ridelab`);
  if (error && !tuning && !isTransient(error)) {
    return isNotFound(error) ? (
      <Blank title="There is no tuning at this address" text="The address may be incomplete, or the tuning was made on another server.">
        <Anchor renderRoot={(props) => <Link to="/tuner" {...props} />}>Start a tuning</Anchor>
      </Blank>
    ) : (
      <CouldNotLoad what="tuning" message={error.message} />
    );
  }
  if (!tuning || !catalogues) return <Loading label="Loading the tuning" heights={[28, 150, 420]} />;
  return (
    <>
      <h1 className={ui.title}>Weights of {strategy ?? tuning.strategy}, tuned</h1>
      <TuningState {...{ tuning, connected, left }} {...catalogues} />
      <TuningResults tuning={tuning} {...catalogues} />
    </>
  );
}

function TuningResults({ tuning, form, strategies, figures }: { readonly tuning: Tuning } & NonNullable<Props["catalogues"]>) {
  const objectives = useMemo(() => tuning.objectives.map((each) => ofObjective(each, figures)), [tuning.objectives, figures]);
  const limits = useMemo(() => tuning.limits.map((each) => ofLimit(each, figures)), [tuning.limits, figures]);
  const tunable = useMemo(() => tunableOf(form, tuning.strategy), [form, tuning.strategy]);
  const points = useMemo(() => pointsOf(tuning, objectives.map(({ label }) => label)), [tuning, objectives]);
  const load = useLoad(tuning);
  const colour = strategies.find(({ id }) => id === tuning.strategy)?.colour ?? "currentColor";
  const warning = warningOf(tuning);
  return (
    <>
      {warning !== null && (
        <Text size="sm" role="status" className={ui.warning ?? ""}>
          {warning}
        </Text>
      )}
      {load.error && (
        <Fault size="sm">These weights could not be loaded: {explain(load.error)}</Fault>
      )}
      <TuningPlot {...{ tuning, objectives, limits, tunable, points, colour, load }} />
      {points.length > 0 && <PointsTable {...{ tuning, objectives, limits, tunable, points, load }} />}
      <ValidationTable {...{ tuning, objectives, figures }} />
    </>
  );
}

function warningOf({ paper, trials }: Tuning): string | null {
  if (paper === null) return null;
  if (trials.feasible === 0) return "No trial so far is within the limits on every training road.";
  if (paper.status === "failed") return "The paper’s weights could not be driven: there is nothing to compare with.";
  return paper.feasible ? null : "The paper’s own weights are over a limit on the training roads: weights within the limits may give larger objectives.";
}
