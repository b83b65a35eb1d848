/** How far a sweep is and what it sweeps over, and a list of those there are. */

import { Button } from "@mantine/core";
import { resumeBatch } from "../../api/jobs";
import type { Batch } from "../../api/types";
import { otherThanPaper } from "../scenarioSource/ScenarioChoice";
import { useForm, useStrategies } from "../../server/useCatalogues";
import { isFinal, BATCH, useJobCall } from "../../jobs/useJob";
import { historyOf, JobState, JobList } from "../../jobs/Jobs";
import { count, formatWhole } from "../../units/format";
import { Fault, Note } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";
import { titleOf } from "./table";

interface Props {
  readonly batch: Batch;
  readonly connected: boolean;
  readonly left: number | null;
  readonly readOnly: boolean;
}

export function BatchState({ batch, connected, left, readOnly }: Props) {
  const resume = useJobCall(BATCH, batch.id, () => resumeBatch(batch.id));
  const goOn = batch.resumable && (
    <Button loading={resume.isPending} onClick={() => resume.mutate(undefined)}>
      Resume
    </Button>
  );
  return (
    <JobState
      kind={BATCH}
      job={batch}
      counts={batch.total > 0 && <Counts batch={batch} />}
      {...{ left, connected, readOnly }}
      resume={goOn}
    >
      {batch.problem?.errors.map(({ pointer, message }) => (
        <Fault key={pointer}>
          {pointer}: {message}
        </Fault>
      ))}
      {resume.isError && <Fault>It could not be resumed: {resume.error.message}</Fault>}
      <Note>
        {facts(batch)}.{" "}
        {otherThanPaper(
          batch.scenario,
          useForm(),
          batch.fields.map(({ name }) => name),
        )}
      </Note>
    </JobState>
  );
}

/** `1 ok, 2 failed of 3 runs`; `12 of 60 runs finished` where nothing has failed. */
function Counts({ batch }: { readonly batch: Batch }) {
  const ended = isFinal(batch);
  const finished = batch.done + batch.failed;
  const failed = <span className={ui.error}>{formatWhole(batch.failed)} failed</span>;
  if (batch.failed === 0) return `${formatWhole(finished)} of ${count(batch.total, "run")} finished`;
  const whole = finished === batch.total ? ` of ${count(batch.total, "run")}` : "";
  return (
    <>
      {!(ended && whole) && `${formatWhole(finished)} of ${count(batch.total, "run")} finished: `}
      {formatWhole(batch.done)} ok, {failed}
      {ended && whole}
    </>
  );
}

function facts(batch: Batch): string {
  const { strategies, total } = batch;
  const points = total > 0 ? `${count(total / strategies.length, "point")} × ` : "";
  return `${points}${count(strategies.length, "strategy", "strategies")} · submitted ${historyOf(batch)}`;
}

interface ListProps {
  readonly studies?: boolean;
  readonly current?: string;
}

export function SweepList({ studies = false, ...rest }: ListProps) {
  const strategies = useStrategies();
  return (
    <JobList
      kind={BATCH}
      title={studies ? "Earlier studies" : "Sweeps"}
      {...(studies && { label: STUDY_LABEL })}
      none={
        studies
          ? "None yet. Choose in the form what is uncertain and start; each study stays here with all its runs."
          : "None yet. Sweep… in the lab’s header runs a scenario over any of its fields; each sweep stays here with all its runs."
      }
      describe={({ label, fields, strategies: swept }) => ({
        title: studies ? count(fields.length, "uncertain field") : titleOf(fields),
        details: [swept.map((id) => strategies.find((strategy) => strategy.id === id)?.label ?? id).join(", ")],
        ...(label === STUDY_LABEL && { page: "/robustness/$id" }),
      })}
      {...rest}
    />
  );
}

/** By this name a sweep is a robustness study. */
export const STUDY_LABEL = "Robustness study";
