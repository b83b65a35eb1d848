/** One tuning: how far it is, what it found, and whether that holds on other roads. */

import { Anchor, Button, Skeleton, Text } from "@mantine/core";
import { useDocumentTitle } from "@mantine/hooks";
import { useQueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import { ApiProblem, isNotFound, isTransient } from "../api/problem";
import type { Strategy, Tuning } from "../api/types";
import type { Figure } from "../batch/figures";
import type { Group } from "../editor/schema";
import { TUNING, useJob } from "../jobs/useJob";
import { Blank } from "../shell/Blank";
import { ofLimit, ofObjective } from "./figures";
import { ValidationTable } from "./ValidationTable";
import { pointsOf } from "./points";
import { PointsTable } from "./PointsTable";
import { tunableOf } from "./space";
import { TuningPlot } from "./TuningPlot";
import { TuningState } from "./TuningState";
import classes from "./tuner.module.css";
import { useLoad } from "./useLoad";

interface Props {
  readonly id: string;
  /** All there is to know first; `null` until it is there. */
  readonly ground: { readonly form: Group; readonly strategies: readonly Strategy[]; readonly figures: readonly Figure[] } | null;
}

export function TuningPage({ id, ground }: Props) {
  const queries = useQueryClient();
  const { job: tuning, error, connected, left } = useJob(TUNING, id);
  const strategy = ground?.strategies.find((each) => each.id === tuning?.strategy)?.label;
  useDocumentTitle(`${strategy === undefined ? "Tuning" : `Weights of ${strategy}`} · Ridelab`);
  if (error && !tuning && !isTransient(error)) {
    return isNotFound(error) ? (
      <Blank title="There is no tuning at this address" text="The address may be cut short, or the tuning was made on another server.">
        <Anchor href="/tuner">Start a tuning</Anchor>
      </Blank>
    ) : (
      <Blank title="This tuning could not be shown" text={error.message}>
        <Button onClick={() => void queries.refetchQueries()}>Try again</Button>
      </Blank>
    );
  }
  if (!tuning || !ground) return <TuningLoading />;
  return (
    <>
      <h1 className={classes.heading}>Weights of {strategy ?? tuning.strategy}, tuned</h1>
      <TuningState {...{ tuning, connected, left }} {...ground} />
      <Found tuning={tuning} {...ground} />
    </>
  );
}

function Found({ tuning, form, strategies, figures }: { readonly tuning: Tuning } & NonNullable<Props["ground"]>) {
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
        <Text size="sm" role="status" className={classes.warning ?? ""}>
          {warning}
        </Text>
      )}
      {load.error && (
        <Text size="sm" role="alert" className={classes.failed ?? ""}>
          These weights could not be loaded: {load.error instanceof ApiProblem && load.error.errors[0] ? load.error.errors[0].message : load.error.message}
        </Text>
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

function TuningLoading() {
  return (
    <div className={classes.loading} aria-busy aria-label="Loading the tuning">
      <Skeleton height={28} width="40%" />
      <Skeleton height={150} radius={8} />
      <Skeleton height={420} radius={8} />
    </div>
  );
}
